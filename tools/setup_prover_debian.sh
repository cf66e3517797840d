#!/bin/sh
# Installs CBMC 6, CaDiCaL and z3 of Debian 13 on another Linux: debootstrap makes a Debian 13 in the
# cache folder, once. debootstrap needs root, but the programs do not: the folder `programs` has
# scripts that start them with the loader and the libraries of this Debian. Put this folder on the
# PATH. The Debian is made in a temporary folder, by one run at a time, so an interrupted run leaves
# no incomplete Debian.
set -eu
root=${XDG_CACHE_HOME:-$HOME/.cache}/rossmarie/prover
programs=$root/programs

runs() { # true if this program of the Debian runs
    "$programs/$1" --version >/dev/null 2>&1
}

is_whole() {
    runs cbmc && runs goto-cc && runs goto-instrument && runs cadical && runs z3
}

write_programs() {
    loader=$(ls "$root"/lib64/ld-linux-*.so.* "$root"/lib/ld-linux-*.so.* 2>/dev/null | head -n 1)
    libraries=$(ls -d "$root"/usr/lib/*-linux-gnu | head -n 1):$root/usr/lib
    mkdir -p "$programs"
    for name in cbmc goto-cc goto-instrument cadical z3; do
        printf '#!/bin/sh\nexec "%s" --library-path "%s" "%s" "$@"\n' \
            "$loader" "$libraries" "$root/usr/bin/$name" >"$programs/$name"
        chmod 755 "$programs/$name"
    done
}

mkdir -p "$(dirname "$root")"
exec 9>"$root.lock"
flock 9
is_whole && exit 0
if [ ! -x "$root/usr/bin/cbmc" ]; then
    command -v debootstrap >/dev/null || {
        echo "setup: debootstrap is missing; please install it" >&2
        exit 1
    }
    echo "setup: making a Debian 13 with CBMC 6 in $root; this happens only once"
    rm -rf --one-file-system "$root"-*
    aside=$(mktemp -d "$root-XXXXXX")
    trap 'rm -rf --one-file-system "$aside" "$aside.log"' EXIT
    trap 'exit 130' INT TERM
    chmod 755 "$aside"
    debootstrap --variant=minbase --force-check-gpg --include=cbmc,cadical,z3 trixie "$aside" \
        >"$aside.log" 2>&1 9>&- || {
        grep -v '^I: ' "$aside.log" | tail -n 1 >&2
        echo "setup: debootstrap failed; it needs root and a mirror of Debian" >&2
        exit 1
    }
    rm -rf --one-file-system "$root"
    mv "$aside" "$root"
fi
write_programs
is_whole || {
    echo "setup: the programs from debootstrap do not run; remove $root and try again" >&2
    exit 1
}
