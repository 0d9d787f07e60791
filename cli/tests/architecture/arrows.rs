//! The rules, on texts, so that the tests below can feed them a small wrong house.

use crate::{
    drawing::{Floor, floor},
    source,
};
use std::collections::BTreeSet;

/// The crates as drawn.
pub fn crates(drawing: &str) -> Option<Floor> {
    floor(drawing, "crates")
}

/// A file that is a test as a whole: declared under `#[cfg(test)]` by its parent.
pub fn is_test_file(file: &str) -> bool {
    file.ends_with("/tests.rs") || file.contains("/tests/")
}

/// Faults of the dependencies in `(path, text)` of every member's Cargo.toml.
pub fn between_crates(drawing: &str, manifests: &[(String, String)]) -> Vec<String> {
    let Some(order) = crates(drawing) else {
        return vec!["ARCHITECTURE.md: no block ```crates".to_owned()];
    };
    let mut faults = Vec::new();
    let mut built = BTreeSet::new();
    for (path, text) in manifests {
        let folder = path.trim_end_matches("/Cargo.toml");
        let name = folder.rsplit('/').next().unwrap_or(folder);
        built.insert(name.to_owned());
        let Some(own) = order.place(name) else {
            faults.push(format!(
                "ARCHITECTURE.md:{}: crate `{name}` ({path}) is missing in this block: add a line `{name}`",
                order.line
            ));
            continue;
        };
        for (line, dependency) in house_dependencies(text) {
            match order.place(&dependency) {
                Some(below) if below < own => {}
                Some(_) => faults.push(format!(
                    "{path}:{line}: `{name}` depends on `{dependency}`, which does not stand below it \
                     (ARCHITECTURE.md:{} and :{})",
                    order.rooms[own].line,
                    order.place(&dependency).map_or(0, |at| order.rooms[at].line),
                )),
                None => faults.push(format!(
                    "{path}:{line}: `{name}` depends on `{dependency}`, which the block ```crates \
                     (ARCHITECTURE.md:{}) does not know",
                    order.line
                )),
            }
        }
    }
    faults.extend(unbuilt(&order, |name| built.contains(name), "crate"));
    faults
}

/// Crates of this house in any dependency table, development and build ones too: Cargo allows
/// those to point back, the drawing does not.
fn house_dependencies(manifest: &str) -> Vec<(usize, String)> {
    let mut in_dependencies = false;
    let mut found = Vec::new();
    for (text, line) in manifest.lines().zip(1..) {
        let text = text.trim();
        let name = if let Some(table) = text.strip_prefix('[') {
            let table = table.trim_end_matches(']');
            in_dependencies = table.ends_with("dependencies");
            table.split_once("dependencies.").map(|(_, name)| name)
        } else {
            in_dependencies.then_some(text)
        };
        if let Some(name) = name.and_then(|name| name.trim_matches('"').strip_prefix("sommerfeld-"))
        {
            let end = name
                .find(|c: char| !c.is_alphanumeric() && c != '-')
                .unwrap_or(name.len());
            found.push((line, name[..end].to_owned()));
        }
    }
    found
}

/// Faults of the module order of one crate; `sources` are `(path, text)` below `src`.
pub fn inside_crate(
    drawing: &str,
    name: &str,
    src: &str,
    sources: &[(String, String)],
) -> Vec<String> {
    let Some(order) = floor(drawing, &format!("modules {name}")) else {
        return vec![format!(
            "ARCHITECTURE.md: no block ```modules {name}: add one with the modules of {src} from the bottom up"
        )];
    };
    let top = |path: &str| {
        path.strip_prefix(src)
            .and_then(|file| source::module_path(file).into_iter().next())
    };
    let modules: BTreeSet<String> = sources.iter().filter_map(|(path, _)| top(path)).collect();

    let mut faults: Vec<String> = modules
        .iter()
        .filter(|module| order.place(module).is_none())
        .map(|module| {
            format!(
                "ARCHITECTURE.md:{}: module `{module}` of {src} is missing in this block: add a line \
                 `{module}` above the modules that use it and below those it uses",
                order.line
            )
        })
        .collect();
    faults.extend(unbuilt(&order, |room| modules.contains(room), "module"));

    let mut root = source::Root::default();
    for (path, text) in sources {
        if top(path).is_none() {
            match source::read_root(text) {
                Ok(read) => root.aliases.extend(read.aliases),
                Err(error) => faults.push(format!("{path}: {error}")),
            }
        }
    }

    for (path, text) in sources {
        let Some(from) = top(path).filter(|_| !is_test_file(path)) else {
            continue; // the crate root opens every room
        };
        let module = source::module_path(&path[src.len()..]);
        let mentions = match source::read(text, &module) {
            Ok(source) => source.mentions,
            Err(error) => {
                faults.push(format!("{path}: {error}"));
                continue;
            }
        };
        for mention in mentions {
            let line = mention.line;
            let to = if modules.contains(&mention.name) {
                &mention.name
            } else if let Some(origin) = root.aliases.get(&mention.name) {
                origin
            } else {
                faults.push(format!(
                    "{path}:{line}: `crate::{}` is neither a module nor re-exported by name in the crate \
                     root: name the module it lives in, or, if it is defined in the root, move it to a \
                     module (the root only opens the rooms)",
                    mention.name
                ));
                continue;
            };
            if let (Some(from_at), Some(to_at)) = (order.place(&from), order.place(to))
                && to_at > from_at
            {
                faults.push(format!(
                    "{path}:{line}: module `{from}` uses `{to}` (`crate::{}`), which stands above it: \
                     ARCHITECTURE.md:{} has `{from}`, :{} has `{to}`",
                    mention.name, order.rooms[from_at].line, order.rooms[to_at].line,
                ));
            }
        }
    }
    faults
}

/// Rooms drawn but not there, or there but drawn as planned.
fn unbuilt(order: &Floor, is_built: impl Fn(&str) -> bool, kind: &str) -> Vec<String> {
    order
        .rooms
        .iter()
        .filter_map(|room| match (is_built(&room.name), room.planned) {
            (false, false) => Some(format!(
                "ARCHITECTURE.md:{}: {kind} `{}` is drawn but there is no such {kind}: delete the line or \
                 mark it `(planned)`",
                room.line, room.name
            )),
            (true, true) => Some(format!(
                "ARCHITECTURE.md:{}: {kind} `{}` is marked `(planned)` but it is there: delete the mark",
                room.line, room.name
            )),
            _ => None,
        })
        .collect()
}

/// Paths that exist on one machine only, with their line.
pub fn machine_paths(text: &str) -> Vec<(usize, &'static str)> {
    // in two pieces, so that this file does not name them
    const PLACES: [&str; 7] = [
        concat!("../", "shared"),
        concat!("/", "work/"),
        concat!("/", "root/"),
        concat!("/", "tmp/"),
        concat!("/", "home/"),
        concat!("/", "Users/"),
        concat!("C:", "\\Users"),
    ];
    text.lines()
        .zip(1..)
        .flat_map(|(line, number)| {
            PLACES
                .into_iter()
                .filter(|place| begins_a_path(line, place))
                .map(move |place| (number, place))
        })
        .collect()
}

/// `place` stands at the start of a path, not inside a longer one or a web address.
fn begins_a_path(line: &str, place: &str) -> bool {
    line.match_indices(place).any(|(at, _)| {
        let before = line[..at].chars().next_back();
        !before.is_some_and(|c| c.is_alphanumeric() || "-_./}".contains(c))
            || place.starts_with('.')
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRAWING: &str = "\
# House
```crates
oil      laws
film     one instant
cli      shell
fmu      (planned) co-simulation
```
```modules film
state    how it moves
gap
force    the waist
solver
energy   (planned)
```
";

    fn manifest(name: &str, text: &str) -> (String, String) {
        (format!("crates/{name}/Cargo.toml"), text.to_owned())
    }

    fn manifests(film: &str) -> Vec<(String, String)> {
        vec![
            manifest("oil", "[dependencies]\nserde = \"1\""),
            manifest("film", film),
            manifest("cli", "[dependencies.sommerfeld-film]\nworkspace = true"),
        ]
    }

    fn crate_faults(film: &str) -> Vec<String> {
        between_crates(DRAWING, &manifests(film))
    }

    /// Faults of a crate `film` with this text in one of its files.
    fn film_faults(file: &str, text: &str) -> Vec<String> {
        let mut sources: Vec<(String, String)> = ["state", "gap", "force", "solver"]
            .map(|name| (format!("crates/film/src/{name}.rs"), String::new()))
            .into();
        sources.push((
            "crates/film/src/lib.rs".to_owned(),
            "pub mod state;\npub use force::{Reaction, Tangent as Slope};\npub use state::State;"
                .to_owned(),
        ));
        let path = format!("crates/film/src/{file}");
        sources.retain(|(other, _)| *other != path);
        sources.push((path, text.to_owned()));
        inside_crate(DRAWING, "film", "crates/film/src/", &sources)
    }

    fn assert_one(faults: &[String], parts: &[&str]) {
        assert_eq!(faults.len(), 1, "{faults:?}");
        for part in parts {
            assert!(faults[0].contains(part), "{part:?} not in {:?}", faults[0]);
        }
    }

    #[test]
    fn dependencies_down_the_house_pass() {
        assert_eq!(
            crate_faults("[dependencies]\nsommerfeld-oil.workspace = true"),
            [""; 0]
        );
    }

    #[test]
    fn a_dependency_up_the_house_is_named() {
        for table in ["dependencies", "dev-dependencies", "build-dependencies"] {
            let faults = crate_faults(&format!("[{table}]\nsommerfeld-cli = {{ path = \"\" }}"));
            assert_one(
                &faults,
                &["crates/film/Cargo.toml:2", "`film` depends on `cli`"],
            );
        }
        let faults = crate_faults("[target.'cfg(unix)'.dependencies.sommerfeld-cli]");
        assert_one(
            &faults,
            &["crates/film/Cargo.toml:1", "`film` depends on `cli`"],
        );
    }

    #[test]
    fn crates_missing_on_either_side_are_named() {
        let mut with_engine = manifests("");
        with_engine.push(manifest("engine", ""));
        assert_one(
            &between_crates(DRAWING, &with_engine),
            &["ARCHITECTURE.md:2", "`engine`", "is missing"],
        );
        assert_one(
            &between_crates(DRAWING, &manifests("")[1..]),
            &["ARCHITECTURE.md:3", "`oil`", "no such crate"],
        );
    }

    #[test]
    fn modules_down_the_house_pass() {
        let text = "use crate::{Reaction, gap::Gap, state};\nfn f(s: &crate::State) {}";
        assert_eq!(film_faults("solver.rs", text), [""; 0]);
        assert_eq!(film_faults("gap.rs", "use super::state::State;"), [""; 0]);
    }

    #[test]
    fn a_reverse_arrow_is_named_with_file_line_and_module() {
        for text in [
            "//! Gap.\nuse crate::solver::Solver;",
            "\nuse crate::{state, solver};",
            "\nuse super::solver::Solver;",
            "\nfn f() -> usize { crate::solver::size() }",
            "\nmod inner { use crate::solver; }",
            "\nmod inner { use super::super::solver; }",
            "\nmacro_rules! m { () => { $crate::solver::f() } }",
            "\n#[cfg(not(test))] use crate::solver;",
        ] {
            let faults = film_faults("gap.rs", text);
            assert_one(
                &faults,
                &["crates/film/src/gap.rs:2", "`gap` uses `solver`"],
            );
        }
    }

    #[test]
    fn a_reverse_arrow_through_a_re_export_or_from_a_submodule_is_named() {
        assert_one(
            &film_faults("gap.rs", "use crate::Reaction;"),
            &["`gap` uses `force`", "crate::Reaction"],
        );
        assert_one(
            &film_faults("gap.rs", "use crate::Slope;"),
            &["`gap` uses `force`"],
        );
        assert_one(
            &film_faults("gap/bore.rs", "use crate::solver::Solver;"),
            &["gap/bore.rs:1", "`gap` uses `solver`"],
        );
    }

    #[test]
    fn paths_inside_a_module_are_its_own_affair() {
        let text = "use super::solver; use self::x; use super::super::state;";
        assert_eq!(film_faults("gap/bore.rs", text), [""; 0]);
    }

    #[test]
    fn comments_strings_and_tests_are_exempt() {
        let text = "/// See [`crate::solver`].\n// crate::solver\nconst A: &str = \"crate::solver\";\n\
                    #[cfg(test)]\nmod tests {\n use crate::solver::Solver;\n}\n\
                    #[cfg(test)]\nuse crate::solver::{A, B};\npub(crate) fn f() {}";
        assert_eq!(film_faults("gap.rs", text), [""; 0]);
        assert_eq!(
            film_faults("gap/tests.rs", "use crate::solver::A;"),
            [""; 0]
        );
        let lines = source::read(text, &[]).map(|source| source.lines);
        assert_eq!(lines, Ok(text.lines().count() - 6));
    }

    #[test]
    fn names_that_cannot_be_placed_are_named() {
        assert_one(
            &film_faults("gap.rs", "use crate::*;"),
            &["crate::*", "name the module"],
        );
    }

    #[test]
    fn modules_missing_on_either_side_are_named() {
        assert_one(
            &film_faults("heat.rs", ""),
            &["ARCHITECTURE.md:8", "`heat`", "is missing"],
        );
        assert_one(
            &film_faults("energy.rs", ""),
            &["ARCHITECTURE.md:13", "`energy`", "delete the mark"],
        );
        let drawn = DRAWING.replace("solver", "solver\nbore");
        let faults = inside_crate(&drawn, "film", "crates/film/src/", &[]);
        assert!(
            faults
                .iter()
                .any(|fault| fault.starts_with("ARCHITECTURE.md:13: module `bore` is drawn")),
            "{faults:?}"
        );
    }

    #[test]
    fn machine_paths_are_found_and_addresses_are_not() {
        let text = format!(
            "a\n\"{}x\" and {}x",
            concat!("/", "tmp/"),
            concat!("/", "home/")
        );
        assert_eq!(
            machine_paths(&text),
            [(2, concat!("/", "tmp/")), (2, concat!("/", "home/"))]
        );
        let fine = format!("https://example.org{}x target{0}y", concat!("/", "work/"));
        assert_eq!(machine_paths(&fine), []);
    }
}
