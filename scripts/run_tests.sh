#!/bin/bash
# run_tests.sh BUILD_FOLDER [FOLDER...]: runs every test of a build, or those of these folders of tests/, shows what
# failed, and ends with one line that counts them.
set -euo pipefail
build=$(realpath "$1")
shift
wanted=.
[ $# -eq 0 ] || wanted="^($(IFS="|"; echo "$*"))/"
report=$build/tests.xml
rm -f "$report"

status=0
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --no-tests=error --progress \
  --tests-regex "$wanted" --output-junit "$report" || status=$?
[ -e "$report" ] || exit $((status == 0 ? 1 : status))

# The first element of the report counts: <testsuite ... tests="9" failures="1" disabled="0" skipped="2" ...>.
count() { tr '\n\t' '  ' <"$report" | grep -o "<testsuite [^>]*" | grep -o " $1=\"[0-9]*\"" | tr -dc 0-9; }
failed=$(count failures)
skipped=$(($(count skipped) + $(count disabled)))
passed=$(($(count tests) - failed - skipped))
echo "$passed passed, $failed failed, $skipped skipped"
exit "$status"
