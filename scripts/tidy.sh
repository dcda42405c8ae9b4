#!/usr/bin/env bash
# ./scripts/tidy.sh [commit]: runs clang-tidy over the files of lib/ and apps/ that have changed since
# the commit (default: the one before HEAD), uncommitted changes included. For a changed header it runs
# over the .cpp files that include it.
# ./scripts/tidy.sh --all: over all of them, a quarter of an hour on two cores.
# The checks are in .clang-tidy. Exit code 1 when there is a finding, 77 where the commit
# before HEAD is missing, as in a shallow clone, and cannot be fetched.
set -euo pipefail
cd "$(dirname "$0")/.."

git() {  # the checkout may belong to another user
    command git -c safe.directory='*' "$@"
}

changed_sources() {
    local base=$1
    git diff --name-only --diff-filter=d "$base" -- lib apps
    git ls-files --others --exclude-standard -- lib apps
}

# The .cpp files among the names on standard input, and those that include a header among them.
to_compile() {
    local file
    while read -r file; do
        case $file in
            *.cpp) echo "$file" ;;
            *.h) grep -rlF --include='*.cpp' "#include \"${file#lib/}\"" lib apps || true ;;
        esac
    done
}

if [ "${1:-}" = --all ]; then
    sources=$(find lib apps -name '*.cpp')
else
    # A shallow clone lacks the commit before HEAD.
    if [ $# = 0 ] && ! git rev-parse --verify --quiet HEAD~1 >/dev/null; then
        git fetch --quiet --deepen=1 || { echo "skipped: the commit before HEAD cannot be fetched" >&2; exit 77; }
    fi
    base=$(git rev-parse --verify --quiet "${1:-HEAD~1}^{commit}") ||
        { echo "no commit ${1:-before HEAD}; usage: $0 [commit | --all]" >&2; exit 2; }
    sources=$(changed_sources "$base" | to_compile | sort -u)
fi
[ -n "$sources" ] || { echo "clang-tidy: nothing has changed"; exit 0; }

SONARSIM_PRESET=release SONARSIM_BUILD=no ./scripts/setup.sh clang-tidy
# Configured and never built: clang-tidy reads the compile commands.
SONARSIM_JOINED=OFF cmake --preset release -B build-tidy >/dev/null
# The warnings are GCC's; clang does not know all of their names.
xargs -P "$(nproc)" -n 1 clang-tidy -p build-tidy --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v ' warnings\( treated as errors\)\? generated' >&2) <<<"$sources" ||
    { echo "clang-tidy: findings, see above" >&2; exit 1; }
echo "clang-tidy: $(wc -l <<<"$sources") files without a finding"
