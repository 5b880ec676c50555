"""What the tests of the examples in Python share: a toy city, and what the reader in C++ says of files.

The command line is SOURCE PVS_ANSWERS VEDUTA [FILE]: of a FILE besides the toy city, only what can be asked of any
file is compared.
"""

import atexit
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

source, pvs_answers, veduta = (Path(argument).resolve() for argument in sys.argv[1:4])
examples = source / "examples" / "python"
sys.path.insert(0, str(examples))
sys.dont_write_bytecode = True

work = Path(tempfile.mkdtemp(prefix="veduta-test-"))
atexit.register(shutil.rmtree, work)
os.environ["MPLCONFIGDIR"] = str(work)  # matplotlib complains of a home that it cannot write to


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True).stdout


def run_example(name, *arguments):
    """An example as a user runs it: exit status, what it printed, what it complained of."""
    done = subprocess.run([sys.executable, "-B", str(examples / name), *map(str, arguments)], capture_output=True,
                          text=True, cwd=work)
    return done.returncode, done.stdout, done.stderr


toy = work / "run" / "city.pvs.h5"
toy.parent.mkdir()
output_of(pvs_answers, "toy", toy)
files = [toy, *(Path(argument).resolve() for argument in sys.argv[4:])]
answers = {path: json.loads(output_of(pvs_answers, "ask", path)) for path in files}
