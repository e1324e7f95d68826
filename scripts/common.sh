# What the scripts share; sourced by bash with `set -eu` on. Leaves the shell in the project folder.

cd "$(dirname "${BASH_SOURCE[0]}")/.."

# One sentence and the end. Usage: fail SENTENCE
fail() {
    echo "${0##*/}: $1" >&2
    exit 1
}

# Prints the comment at the top of the script and ends, if WORD asks for help. Usage: help_if_asked WORD
help_if_asked() {
    case ${1:-} in
        -h | --help)
            sed -n '2,/^set/s/^# \{0,1\}//p' "scripts/${0##*/}"
            exit 0
            ;;
    esac
}

# Runs a step and says how long it took; its output is shown if it fails, or with VERBOSE set.
# Usage: step TITLE COMMAND...
step() {
    local title=$1 log start status=0
    shift
    log=$(mktemp)
    start=$(date +%s%N)
    printf '%-44s' "$title ..."
    if [ -n "${VERBOSE:-}" ]; then
        echo
        "$@" || status=$?
    else
        "$@" >"$log" 2>&1 || status=$?
    fi
    printf '%7d.%01d s\n' $((($(date +%s%N) - start) / 1000000000)) \
        $((($(date +%s%N) - start) / 100000000 % 10))
    if [ $status -ne 0 ]; then
        tail -n 60 "$log" >&2
        rm -f "$log"
        fail "\"$title\" failed with status $status; its last lines stand above."
    fi
    rm -f "$log"
}

# The packages of sections of scripts/packages. Usage: packages_of SECTION...
packages_of() {
    local section
    for section; do
        awk -v wanted="[$section]" '/^\[/ { inside = $0 == wanted } inside && /^[a-z0-9]/' \
            scripts/packages
    done
}

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

# Runs apt-get as root. Usage: as_root COMMAND...
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        env DEBIAN_FRONTEND=noninteractive "$@"
    else
        sudo env DEBIAN_FRONTEND=noninteractive "$@"
    fi
}

# What computers need that only light, as build/lighting: not optimised, and without the check of kernels, so that it
# is built sooner. Usage: build_lighting_half TARGET...
build_lighting_half() {
    cmake -G Ninja -S . -B build/lighting -DTILELIGHT_RASTER=OFF -DTILELIGHT_TESTS=OFF -DCMAKE_BUILD_TYPE=Debug \
        -DCMAKE_C_FLAGS_DEBUG=-O0 -DTL_CLANG="$(command -v true)" &&
        cmake --build build/lighting --target "$@"
}

# Installs what is missing of the sections; where nothing is, not even apt-get is called.
# Usage: install_packages SECTION...
install_packages() {
    local package missing=()
    command -v dpkg-query >/dev/null || {
        echo "This is no Debian system: taking for granted the equivalents of" \
            "$(packages_of "$@" | xargs)."
        return 0
    }
    for package in $(packages_of "$@"); do
        is_installed "$package" || missing+=("$package")
    done
    if [ ${#missing[@]} -eq 0 ]; then
        return 0
    fi
    if [ "$(id -u)" -ne 0 ] && ! command -v sudo >/dev/null; then
        fail "packages are missing and there is no sudo; as root run: apt-get install --no-install-recommends ${missing[*]}"
    fi
    echo "Installing ${#missing[@]} packages: ${missing[*]}"
    step "package lists" as_root apt-get -o Acquire::Retries=3 update
    step "packages" as_root apt-get -o Acquire::Retries=3 install -y --no-install-recommends \
        "${missing[@]}"
}
