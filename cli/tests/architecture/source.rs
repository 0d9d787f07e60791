//! Reads Rust sources as token trees: which module names which, without comments, strings and
//! items under `#[cfg(test)]`. Tests may look anywhere: they check a module from outside.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use std::collections::BTreeMap;

/// A path from one source file to a name at the root of its own crate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mention {
    /// First name behind `crate::`, or what `super::` comes to; `*` for a glob.
    pub name: String,
    /// Line of the source, from 1.
    pub line: usize,
}

/// What a crate root (`lib.rs` or `main.rs`) offers under `crate::`.
#[derive(Debug, Default)]
pub struct Root {
    /// Re-exported name -> the module or outer crate it comes from.
    pub aliases: BTreeMap<String, String>,
}

/// What a source file says of itself.
#[derive(Debug)]
pub struct Source {
    pub mentions: Vec<Mention>,
    /// Lines outside `#[cfg(test)]`.
    pub lines: usize,
}

/// Module path of a file below `src`: `a/b.rs` and `a/b/mod.rs` are `["a", "b"]`, `lib.rs` is `[]`.
pub fn module_path(file: &str) -> Vec<String> {
    let stem = file.strip_suffix(".rs").unwrap_or(file);
    let mut path: Vec<String> = stem.split('/').map(str::to_owned).collect();
    if matches!(
        path.last().map(String::as_str),
        Some("mod" | "lib" | "main")
    ) {
        path.pop();
    }
    path
}

/// Reads one file; `module` is its module path.
pub fn read(text: &str, module: &[String]) -> Result<Source, String> {
    let tokens: TokenStream = text.parse().map_err(|error| format!("{error}"))?;
    let mut reader = Reader {
        mentions: Vec::new(),
        lines_of_tests: 0,
    };
    reader.block(tokens, &mut module.to_vec());
    Ok(Source {
        mentions: reader.mentions,
        lines: text.lines().count() - reader.lines_of_tests,
    })
}

/// Reads the `use` lines of a crate root.
pub fn read_root(text: &str) -> Result<Root, String> {
    let tokens: TokenStream = text.parse().map_err(|error| format!("{error}"))?;
    let mut root = Root::default();
    let mut tokens = tokens.into_iter();
    while let Some(token) = tokens.next() {
        if is_ident(&token, "use") {
            let tree: Vec<TokenTree> = tokens.by_ref().take_while(|t| !is_punct(t, ';')).collect();
            leaves(&tree, None, &mut root.aliases);
        }
    }
    Ok(root)
}

struct Reader {
    mentions: Vec<Mention>,
    lines_of_tests: usize,
}

impl Reader {
    fn block(&mut self, tokens: TokenStream, module: &mut Vec<String>) {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            if let Some(after) = end_of_test_item(&tokens, at) {
                let (first, last) = (tokens[at].span(), tokens[after - 1].span());
                self.lines_of_tests += last.end().line - first.start().line + 1;
                at = after;
                continue;
            }
            if let [keyword, name, TokenTree::Group(body), ..] = &tokens[at..]
                && is_ident(keyword, "mod")
                && body.delimiter() == Delimiter::Brace
            {
                module.push(name.to_string());
                self.block(body.stream(), module);
                module.pop();
                at += 3;
                continue;
            }
            if let Some((up, after)) = path_start(&tokens, at) {
                self.path(&tokens[after..], up, module);
                at = after;
                continue;
            }
            if let TokenTree::Group(group) = &tokens[at] {
                self.block(group.stream(), module);
            }
            at += 1;
        }
    }

    /// Notes the names behind `crate::` (`up` is `None`) or behind `up` times `super::`.
    fn path(&mut self, rest: &[TokenTree], up: Option<usize>, module: &[String]) {
        let depth = up.map_or(0, |up| module.len().saturating_sub(up));
        if depth > 0 {
            // still inside the file's own top module
            return;
        }
        match rest.first() {
            Some(TokenTree::Group(group)) if group.delimiter() == Delimiter::Brace => {
                for part in split_at_commas(group) {
                    self.note(part.first());
                }
            }
            first => self.note(first),
        }
    }

    fn note(&mut self, token: Option<&TokenTree>) {
        if let Some(token) = token {
            self.mentions.push(Mention {
                name: token.to_string(),
                line: token.span().start().line,
            });
        }
    }
}

/// If a path into the own crate starts here: how many `super` it has (`None` for `crate`) and
/// where its first name stands.
fn path_start(tokens: &[TokenTree], at: usize) -> Option<(Option<usize>, usize)> {
    let separator = |at: usize| matches!(tokens.get(at..at + 2), Some([a, b]) if is_punct(a, ':') && is_punct(b, ':'));
    if is_ident(&tokens[at], "crate") && separator(at + 1) {
        return Some((None, at + 3));
    }
    let (mut up, mut next) = (0, at);
    while tokens.get(next).is_some_and(|t| is_ident(t, "super")) && separator(next + 1) {
        up += 1;
        next += 3;
    }
    (up > 0).then_some((Some(up), next))
}

/// If `#[cfg(test)]` or `#[test]` stands here: the place behind the item it belongs to.
fn end_of_test_item(tokens: &[TokenTree], at: usize) -> Option<usize> {
    let [hash, TokenTree::Group(attribute), ..] = &tokens[at..] else {
        return None;
    };
    if !is_punct(hash, '#') || !is_test_attribute(attribute) {
        return None;
    }
    let mut is_use = false;
    for (offset, token) in tokens[at + 2..].iter().enumerate() {
        is_use |= is_ident(token, "use");
        let ends = match token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace && !is_use,
            other => is_punct(other, ';'),
        };
        if ends {
            return Some(at + 2 + offset + 1);
        }
    }
    Some(tokens.len())
}

/// `#[test]` or a `#[cfg(...)]` that asks for `test`; not `#[cfg(not(test))]`.
fn is_test_attribute(attribute: &Group) -> bool {
    let words: Vec<TokenTree> = attribute.stream().into_iter().collect();
    match words.as_slice() {
        [only] => is_ident(only, "test"),
        [cfg, TokenTree::Group(condition)] if is_ident(cfg, "cfg") => {
            let condition: Vec<TokenTree> = condition.stream().into_iter().collect();
            match condition.as_slice() {
                [only] => is_ident(only, "test"),
                [all, TokenTree::Group(list)] if is_ident(all, "all") => split_at_commas(list)
                    .iter()
                    .any(|part| matches!(part.as_slice(), [only] if is_ident(only, "test"))),
                _ => false,
            }
        }
        _ => false,
    }
}

/// Walks a `use` tree: every name it brings in, with the first name of its path.
fn leaves(tree: &[TokenTree], first: Option<&str>, found: &mut BTreeMap<String, String>) {
    let mut first = first.map(str::to_owned);
    let mut last = String::new();
    for token in tree {
        match token {
            TokenTree::Ident(name) if name == "crate" || (name == "self" && first.is_none()) => {}
            TokenTree::Ident(name) if name == "as" => {}
            TokenTree::Ident(name) => {
                last = name.to_string();
                first.get_or_insert_with(|| last.clone());
            }
            TokenTree::Group(group) => {
                for part in split_at_commas(group) {
                    leaves(&part, first.as_deref(), found);
                }
                return;
            }
            _ => {}
        }
    }
    if let Some(first) = first {
        found.insert(last, first);
    }
}

fn split_at_commas(group: &Group) -> Vec<Vec<TokenTree>> {
    let tokens: Vec<TokenTree> = group.stream().into_iter().collect();
    tokens
        .split(|token| is_punct(token, ','))
        .filter(|part| !part.is_empty())
        .map(<[TokenTree]>::to_vec)
        .collect()
}

fn is_ident(token: &TokenTree, name: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == name)
}

fn is_punct(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == sign)
}
