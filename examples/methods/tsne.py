"""t-SNE of scikit-learn as a method of mapproof (protocol 1). Debian: python3-sklearn."""
import json
import sys

import numpy
from sklearn.manifold import TSNE

for line in iter(sys.stdin.buffer.readline, b""):
    request = json.loads(line)
    shape = request["rows"], request["columns"]
    distances = numpy.frombuffer(sys.stdin.buffer.read(request["bytes"]), "<f8").reshape(shape)
    seen = numpy.isfinite(distances).sum(axis=1) > 1
    known = distances[numpy.ix_(seen, seen)]
    answer = {"id": request["id"]}
    if not numpy.isfinite(known).all() or len(known) <= request["parameter"]:
        answer["error"] = "too few landmarks, or not all distances are known"
    else:
        tsne = TSNE(metric="precomputed", init="random", perplexity=request["parameter"],
                    learning_rate="auto", random_state=request["seed"] % 2**32)
        rows = iter(tsne.fit_transform(known).tolist())
        answer["coordinates"] = [next(rows) if s else None for s in seen]
    print(json.dumps(answer), flush=True)
