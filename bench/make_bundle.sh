#!/bin/bash
# Packs what bench/device_check.sh needs on a machine that has a graphics card and its driver, but
# no compiler, no Vulkan headers and no network.
#
#   bench/make_bundle.sh BUILD OUT.tar.xz
#
# BUILD is a build folder (build/release) with edgescout_cli, kernels_test and edgescout_bench.
# The other machine needs the same processor family and a C library at least as new as here.
#
# In the archive:
#   bin/    the three programs
#   lib/    every library they load, but the C library
#   spare/  libraries that the other machine mostly has, in a version that fits its driver better:
#           device_check.sh takes one only where the system has none
set -euo pipefail
build=$1 out=$2
programs=("$build/host/cli/edgescout" "$build/tests/kernels_test" "$build/bench/edgescout_bench")
# Parts of the C library: the system's dynamic linker accepts no others.
c_library='^(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util|nsl|anl))\.so'
# The driver loads these too, or finds its own through the loader.
spare='^lib(stdc\+\+|gcc_s|vulkan|X11|Xext|xcb|Xau|Xdmcp|bsd|md)\.so'

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir "$tree"/{bin,lib,spare}
cp "${programs[@]}" "$tree/bin"

libraries_of() { ldd "$@" | awk '$2 == "=>" && $3 ~ "^/" { print $1, $3 }'; }

pack_libraries() { # FILE...
  local name path folder
  libraries_of "$@" | sort -u | while read -r name path; do
    [[ $name =~ $c_library ]] && continue
    folder=lib
    [[ $name =~ $spare ]] && folder=spare
    [ -e "$tree/$folder/$name" ] || cp -L "$path" "$tree/$folder/$name"
  done
}
pack_libraries "${programs[@]}"
# NVIDIA's driver is linked to it, even where there is no display.
xext=$(ldconfig -p | awk '$1 == "libXext.so.6" { print $NF; exit }')
if [ -n "$xext" ]; then
  cp -L "$xext" "$tree/spare/libXext.so.6"
  pack_libraries "$xext"
fi
missing=$(ldd "${programs[@]}" | grep 'not found' || true)
[ -z "$missing" ] || { printf 'not found here:\n%s\n' "$missing" >&2; exit 1; }

chmod -R u+w "$tree"
strip --strip-unneeded "$tree"/*/*

# Nothing may come from outside the archive but the C library.
LD_LIBRARY_PATH=$tree/lib:$tree/spare libraries_of "$tree"/bin/* | sort -u |
  while read -r name path; do
    [[ $path == "$tree"/* || $name =~ $c_library ]] || echo "taken from the system: $name $path"
  done >&2

# A filter for machine code, and a dictionary about as large as the tree.
mkdir -p "$(dirname "$out")"
tar -C "$tree" --sort=name --owner=0 --group=0 --mtime=@0 -cf - bin lib spare |
  xz --x86 --lzma2=preset=9e,dict=192MiB >"$out.part"
mv "$out.part" "$out"
printf '%s: %s libraries, %s MiB, unpacked %s\n' "$out" "$(ls "$tree/lib" "$tree/spare" | wc -l)" \
  "$(($(stat -c %s "$out") / 1048576))" "$(du -sh "$tree" | cut -f1)"
