#!/usr/bin/env bash
# repair_scripts.sh INSTALL: let installed scripts start where the interpreter's path holds a blank.
# No system runs a first line that quotes its interpreter, as setuptools writes it then; pip's scripts
# start with these lines instead. Can be run again at any time.
set -euo pipefail
find "$1" -path '*/lib/*' -type f -perm -u+x -exec \
  sed -i "1s|^#!\"\(.*\)\"\$|#!/bin/sh\n'''exec' \"\1\" \"\$0\" \"\$@\"\n' '''|" {} +
