#!/usr/bin/env bash
# check_scripts.sh ROOT: fails when a shell script has a syntax error or one that is meant to be run can't be.
set -euo pipefail
cd "$1"
bad=0
for script in bake.sh test.sh .ci/run cmake/*.sh tests/*.sh tests/house/*.sh tests/farm/*.sh tests/library/*.sh tests/cluster/*.sh tests/python/*.sh configs/slurm/*.sbatch; do
  bash -n "$script" || bad=1
done
for script in bake.sh test.sh .ci/run cmake/install_packages.sh; do
  [[ -x $script ]] || { echo "$script: not executable; chmod +x $script"; bad=1; }
done
exit $bad
