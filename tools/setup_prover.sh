#!/bin/sh
# Installs CBMC 6 for the tests of proofs: from Debian 13, or from a Debian 13 in the cache folder
# (setup_prover_debian.sh), which the tests put on their PATH. Without CBMC 6, these tests are skipped
# and the test run reports this. This program never fails.
set -u
cd "$(dirname "$0")"

has_package() { # whether this Debian is one that has it
    [ "$(. /etc/os-release && echo "${ID:-}")" = debian ] &&
        [ "$(. /etc/os-release && echo "${VERSION_ID:-0}")" -ge 13 ]
}

if ! cbmc --version 2>/dev/null | grep -q '^6\.' || ! command -v cadical >/dev/null ||
    ! command -v z3 >/dev/null; then
    if has_package 2>/dev/null; then
        ./setup_debian.sh cbmc cadical z3 gcc libc6-dev
    else
        ! command -v apt-get >/dev/null || command -v debootstrap >/dev/null ||
            ./setup_debian.sh debootstrap
        ./setup_prover_debian.sh || echo "setup: without CBMC 6, proofs are not tested"
    fi
fi
