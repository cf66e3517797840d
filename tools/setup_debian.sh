#!/bin/sh
# Installs Debian packages: tools/setup_debian.sh PACKAGE... Without root, without apt-get, or offline,
# this program only prints the packages to install. It never fails: the program that needs a package
# reports that the package is missing.
set -u
packages="$*"

if ! command -v apt-get >/dev/null; then
    echo "setup: not Debian; please install the equivalents of these Debian packages: $packages"
elif [ "$(id -u)" -ne 0 ]; then
    echo "setup: not root; please run: sudo apt-get install $packages"
else
    echo "setup: installing from Debian: $packages"
    export DEBIAN_FRONTEND=noninteractive
    { apt-get update -qq && apt-get install -qq --no-install-recommends $packages; } >/dev/null ||
        echo "setup: could not install: $packages"
fi
