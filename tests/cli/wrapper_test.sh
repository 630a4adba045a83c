#!/usr/bin/env bash
# The wrapper ./plumbline before there is anything to run: what it says and does when packages are missing. The package
# database and the build are stood in for; the real ones are used by every run of this test suite itself.
#   wrapper_test.sh SOURCE_DIR
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$1/plumbline" "$folder/plumbline"
mkdir -p "$folder/fake"
export PATH=$folder/fake:$PATH PLUMBLINE_NO_INSTALL=1

# dpkg-query knows all packages but those in $ABSENT; cmake notes its calls and "builds" a program that says so.
cat > "$folder/fake/dpkg-query" <<'END'
#!/bin/sh
shift 3
for package in "$@"; do case " $ABSENT " in *" $package "*) ;; *) printf 'installed=%s ' "$package" ;; esac; done
END
cat > "$folder/fake/cmake" <<END
#!/bin/sh
echo "\$*" >> "$folder/cmake.calls"
mkdir -p "$folder/build/release/bin" && touch "$folder/build/release/build.ninja"
printf '#!/bin/sh\necho the program got: "\$@"\nexit 5\n' > "$folder/build/release/bin/plumbline"
chmod +x "$folder/build/release/bin/plumbline"
END
chmod +x "$folder/fake/"*

failures=0
check() {  # NAME EXPECTED-STATUS ABSENT-PACKAGES PATTERN...: runs the wrapper; its output must hold every pattern
  local name=$1 expected=$2 status=0 output
  export ABSENT=$3
  shift 3
  output=$("$folder/plumbline" list --json 2>&1 </dev/null) || status=$?
  if ((status != expected)); then
    echo "FAILED $name: status $status instead of $expected"; echo "$output"; failures=$((failures + 1))
  fi
  for pattern in "$@"; do
    if ! grep -qF -- "$pattern" <<<"$output"; then
      echo "FAILED $name: no '$pattern' in:"; echo "$output"; failures=$((failures + 1))
    fi
  done
}

check names_what_is_missing_and_stops 3 "libeigen3-dev libode-dev" \
  "apt-get install --no-install-recommends libeigen3-dev libode-dev"
[[ ! -e $folder/cmake.calls ]] || { echo "FAILED: it built although packages are missing"; failures=$((failures + 1)); }
check goes_on_without_an_engine 5 "libode-dev" "configuring (release)" "the program got: list --json"
calls=$(wc -l < "$folder/cmake.calls")
check hands_over_arguments_and_status 5 "libode-dev" "the program got: list --json"
(($(wc -l < "$folder/cmake.calls") == calls + 1)) || { echo "FAILED: it configured again for nothing"; failures=$((failures + 1)); }
check configures_again_when_an_engine_came 5 "" "configuring (release)" "the program got: list --json"

export PLUMBLINE_ENGINES="kinetics;box2d"
check asks_only_for_the_engines_that_are_wanted 5 "libode-dev" "configuring (release)" "the program got: list --json"
grep -qF -- "-DPLUMBLINE_ENGINES=kinetics;box2d" "$folder/cmake.calls" ||
  { echo "FAILED: cmake was not told which engines are wanted"; failures=$((failures + 1)); }

((failures == 0)) && echo "wrapper: 5 situations as they should be"
exit $((failures > 0))
