#!/usr/bin/env bash
# install_test.sh BUILD_DIRECTORY TOY_FILE CMAKE GENERATOR COMPILER LIBRARY_MD: installs the library to a prefix of its own,
# builds the example outside of the tree with find_package, and runs it; compiles the frame of docs/library.md.
set -euo pipefail
build=$1 toy_file=$2 cmake=$3 generator=$4 compiler=$5 document=$6
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "install_test.sh: $*" >&2; exit 1; }

expect() { # WHAT SAID_FILE, what should be said on standard input
  diff -u - "$2" || fail "$1: not what is known"
}

"$cmake" --install "$build" --prefix "$work/prefix" --component library >"$work/install.log" || fail "the installation failed"
header=$work/prefix/include/veduta/pvs.h
library=$(find "$work/prefix" -name libveduta.so)
[[ -f $header && -e $library ]] || fail "header or library missing: $(cat "$work/install.log")"
for file in share/doc/veduta/LICENSE share/veduta/examples/visible_buildings/CMakeLists.txt; do
  [[ -f $work/prefix/$file ]] || fail "$file missing"
done

# The header needs nothing but the standard library, and what is installed knows nothing of the tree it came from.
if grep -n '#include' "$header" | grep -vE '#include <[a-z_]+>$'; then fail "pvs.h includes more than the standard library"; fi
if grep -rlF "$build" "$work/prefix" --include='*.cmake' --include='*.h'; then fail "these name the build directory"; fi

# What the library shows is its interface, and it brings neither GL nor MPI along.
nm -DC --defined-only "$library" | sed -E 's/^[0-9a-f]* *[A-Za-z] //' >"$work/symbols"
grep -q '^veduta::pvs::City::find_cell' "$work/symbols" || fail "the library has no City::find_cell"
if grep -vE '^((typeinfo|typeinfo name|vtable) for )?veduta::pvs::(City|Geometry|Error|unite)\b' "$work/symbols"; then
  fail "the library shows more than its interface"
fi
ldd "$library" >"$work/needed"
if grep -iE 'not found|libGL|libEGL|libOpenGL|epoxy|libmpi|libgdal|libembree|libtbb' "$work/needed"; then
  fail "the library needs what it should not"
fi

{
  echo '#include <veduta/pvs.h>'
  echo 'void frame(const veduta::pvs::Point& left_eye, const veduta::pvs::Point& right_eye) {'
  sed -n '/^```cpp$/,/^```$/p' "$document" | grep -v '^```'
  echo '}'
} >"$work/frame.cpp"
grep -q 'City city' "$work/frame.cpp" || fail "$document shows no frame"
"$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I"$work/prefix/include" "$work/frame.cpp" || fail "the frame of $document does not compile"

cp -r "$work/prefix/share/veduta/examples/visible_buildings" "$work/example"
"$cmake" -S "$work/example" -B "$work/build" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror" -DCMAKE_PREFIX_PATH="$work/prefix" \
  >"$work/configure.log" 2>&1 || fail "configuring failed: $(cat "$work/configure.log")"
"$cmake" --build "$work/build" >"$work/build.log" 2>&1 || fail "building failed: $(cat "$work/build.log")"
example=$work/build/visible_buildings

"$toy_file" "$work/toy.pvs.h5"
"$example" "$work/toy.pvs.h5" 2 >"$work/said"
expect "cell 2" "$work/said" <<'END'
cell 2, (20, -10, 1) to (30, 0, 2) m
gebouw-é-0: all of it
gebouw-é-2: in part, x -3 y +0 z 2
END
"$example" "$work/toy.pvs.h5" 15 -5 1.5 >"$work/said"
expect "a point in cell 1" "$work/said" <<'END'
cell 1, (10, -10, 1) to (20, 0, 2) m
gebouw-é-0: all of it
END
"$example" "$work/toy.pvs.h5" 0 >"$work/said"
expect "cell 0, which sees nothing" "$work/said" <<<'cell 0, (0, -10, 1) to (10, 0, 2) m'

expect_refused() { # STATUS TEXT ARGUMENTS: one line
  local status=0
  "$example" "${@:3}" >"$work/said" 2>&1 || status=$?
  [[ $status -eq $1 && $(wc -l <"$work/said") -eq 1 ]] && grep -qF "$2" "$work/said" ||
    fail "${*:3}: status $status, said: $(cat "$work/said")"
}
expect_refused 1 "in no cell" "$work/toy.pvs.h5" 15 -5 9
expect_refused 65 "no cell 7: there are 7" "$work/toy.pvs.h5" 7
expect_refused 65 "$work/none.pvs.h5" "$work/none.pvs.h5" 0
head -c 2000 "$work/toy.pvs.h5" >"$work/short.pvs.h5"
expect_refused 65 "$work/short.pvs.h5" "$work/short.pvs.h5" 0
echo "installed, found, built and right"
