#!/bin/sh
# Solves a scene for many values of a constant, as many at a time as there are processors, and gathers a table:
#
#     examples/sweep.sh examples/throw.scene BasketX 2.0 2.5 3.0 > table.tsv
#
# Needs GNU parallel (Debian: parallel). PROGRAMS says where the programs are.
set -eu
scene=$1 constant=$2
shift 2
export PROGRAMS="${PROGRAMS:-build/programs/bin}"

one() {  # SCENE CONSTANT VALUE: one row
  sed "s/^\( *constant  *$2 *=\).*/\1 $3/" "$1" |
    "$PROGRAMS/spacetime-symbolic" compile - |
    { "$PROGRAMS/spacetime-optimizer" solve -o /dev/null 2>&1 || true; } |
    awk -v value="$3" -F '[: ]+' '
      /^(converged|stopped|infeasible|failed):/ { status = $1 }
      /^iterations / { iterations = $2 }
      /^objective / { objective = $2 }
      END { printf "%s\t%s\t%s\t%s\n", value, status, iterations, objective }'
}

printf '%s\tstatus\titerations\tobjective\n' "$constant"
if [ "${1:-}" = --one ]; then
  one "$scene" "$constant" "$2"
else
  parallel --will-cite --keep-order "\"$0\"" "\"$scene\"" "$constant" --one {} '|' tail -n 1 ::: "$@"
fi
