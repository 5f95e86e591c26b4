"""An experiment's file without its side studies, from standard input to standard output."""
import json
import sys

experiment = json.load(sys.stdin)
experiment.pop("variations", None)
json.dump(experiment, sys.stdout)
