#!/usr/bin/env bash
# What a terminal would offer: bash_completion_test.sh COMPLETION_SCRIPT PROGRAM
set -euo pipefail
PATH=$(dirname "$2"):$PATH
# shellcheck source=/dev/null
. "$1"

expect() {  # expect OFFERS WORD...: the last word is the one that is being typed
  local offers=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _contactcheck
  [ "${COMPREPLY[*]}" = "$offers" ] && return
  echo "$*: \"${COMPREPLY[*]}\" is offered, not \"$offers\""
  exit 1
}

expect "reproduce reduce report" contactcheck re
expect "bunny-inside bunny-near-miss bunny-touch" contactcheck run bunny-
expect "ffd-lazy" contactcheck run --detector ffd-la
expect "csv html md" contactcheck report --format ""
expect "--policy" contactcheck gate --po
expect "hard-vertex-face hard-vertex-vertex" contactcheck truth hard-vertex
expect "" contactcheck run --frames ""
expect "$1" contactcheck gate --policy "${1%h}"
