#!/usr/bin/env bash
# Times the benchmarks and prints the machine line and the table of benches/README.md.
#
#   benches/table.sh           measure, then print
#   benches/table.sh --print   print the figures of the last run; benchmarks that it left out are left out
#
# The figures are criterion's: median, its 95 % interval and the fastest sample. The unit of the
# ratios is the fixed kernel of the same run, before and after everything else: for the medians the
# mean of both medians, for the fastest sample the faster of both.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if [[ ${1:-} != --print ]]; then
    cargo bench --locked --package sommerfeld-study --bench speed >&2
fi
figures=${CRITERION_HOME:-${CARGO_TARGET_DIR:-target}/criterion}

# median, lower and upper bound, ns
median() {
    sed -E 's/.*"median":\{"confidence_interval":\{[^}]*"lower_bound":([^,}]*),"upper_bound":([^,}]*)\},"point_estimate":([^,}]*).*/\3 \1 \2/' \
        "$figures/$1/new/estimates.json"
}

# fastest sample, ns
fastest() {
    tr -d '[]{}"' <"$figures/$1/new/sample.json" | LC_ALL=C awk '{
        split($0, part, /,?(iters|times):/)
        n = split(part[2], iterations, ","); split(part[3], times, ",")
        for (k = 1; k <= n; k++)
            if (k == 1 || times[k] / iterations[k] < least) least = times[k] / iterations[k]
        print least
    }'
}

# film updates of one run, or a dash
updates() {
    grep -o '"Elements":[0-9]*' "$figures/$1/new/benchmark.json" | cut -d: -f2 || echo -
}

# A figure belongs to the kernel only if it was taken between its two timings.
same_run() {
    local file=$figures/$1/new/estimates.json kernel=$figures/fixed-kernel
    [[ -e $file && ! $file -ot $kernel/before/new/estimates.json &&
        ! $file -nt $kernel/after/new/estimates.json ]]
}

rows() {
    local id words aim
    while IFS='|' read -r id words aim; do
        same_run "$id" || continue
        echo "$words|$aim|$(median "$id") $(fastest "$id")|$(updates "$id")"
    done <<'ROWS'
fixed-kernel/before|fixed kernel, before|
fixed-kernel/after|fixed kernel, after|
film/mass-conserving-cold|film from cold, `mass-conserving`|10
film/mass-conserving-warm|film, 2 degrees on, `mass-conserving`|4
film/reynolds-cold|film from cold, `reynolds`|3
film/reynolds-warm|film, 2 degrees on, `reynolds`|1
film/gumbel-cold|film from cold, `gumbel`|
film/mass-conserving-whole-cold|whole bearing from cold, `mass-conserving`|
film/reynolds-whole-cold|whole bearing from cold, `reynolds`|
film/gumbel-whole-cold|whole bearing from cold, `gumbel`|
film/short-bearing-update|short bearing, one update|
equilibrium/example-01|equilibrium, example 01|
cycle/example-02|load cycle, example 02|4000
cycle/example-03-short-bearing|load cycle, short bearing, example 03|
ROWS
}

processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo 2>/dev/null | head -n 1)
[[ $processor ]] || processor=$(sysctl -n machdep.cpu.brand_string 2>/dev/null || uname -m)
commit=$(git describe --always --dirty 2>/dev/null || echo unknown)
echo "Machine: $processor, $(getconf _NPROCESSORS_ONLN) cores, $(uname -sr | cut -d- -f1), $(rustc --version), commit $commit."
echo
echo '| benchmark | median | 95 % interval | fastest | ratio of medians | ratio of fastest | aim | film updates |'
echo '|---|---|---|---|---|---|---|---|'
rows | LC_ALL=C awk -F'|' '
    function time(ns) {
        if (ns < 1e3) return sprintf("%.0f ns", ns)
        if (ns < 1e6) return sprintf("%.3g us", ns / 1e3)
        if (ns < 1e9) return sprintf("%.3g ms", ns / 1e6)
        return sprintf("%.3g s", ns / 1e9)
    }
    function ratio(x) { return sprintf(x < 100 ? "%.3g" : "%.0f", x) }
    {
        split($3, ns, " ")
        words[NR] = $1; aim[NR] = $2 == "" ? "-" : time(1e6 * $2); updates[NR] = $4
        median[NR] = ns[1]; lower[NR] = ns[2]; upper[NR] = ns[3]; fastest[NR] = ns[4]
    }
    END {
        unit = (median[1] + median[2]) / 2
        least = fastest[1] < fastest[2] ? fastest[1] : fastest[2]
        for (k = 1; k <= NR; k++)
            printf "| %s | %s | %s to %s | %s | %s | %s | %s | %s |\n", words[k],
                time(median[k]), time(lower[k]), time(upper[k]), time(fastest[k]),
                ratio(median[k] / unit), ratio(fastest[k] / least), aim[k], updates[k]
    }'
