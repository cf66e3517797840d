#!/bin/sh
# Installs Debian packages: tools/setup_debian.sh PACKAGE... Only says what to install where it
# cannot: without root, without apt-get, or offline. Never fails: whoever needs the package tells.
set -u
packages="$*"

if ! command -v apt-get >/dev/null; then
    echo "setup: not Debian; please install what Debian calls: $packages"
elif [ "$(id -u)" -ne 0 ]; then
    echo "setup: not root; please run: sudo apt-get install $packages"
else
    echo "setup: installing from Debian: $packages"
    export DEBIAN_FRONTEND=noninteractive
    { apt-get update -qq && apt-get install -qq --no-install-recommends $packages; } >/dev/null ||
        echo "setup: could not install: $packages"
fi
