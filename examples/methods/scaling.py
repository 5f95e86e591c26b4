"""Classical scaling [torgerson1952] as a method of mapproof (protocol 1), without packages."""
import json
import struct
import sys


def eigenpairs(B):
    """Eigenvalues and eigenvectors (rows) of a symmetric matrix, by Jacobi's rotations."""
    n = len(B)
    V = [[float(i == k) for k in range(n)] for i in range(n)]
    while sum(B[p][q] ** 2 for p in range(n) for q in range(p)) > 1e-28 * sum(
            B[p][p] ** 2 for p in range(n)):
        for p in range(n):
            for q in (q for q in range(p) if B[p][q] != 0):
                angle = (B[q][q] - B[p][p]) / (2 * B[p][q])
                t = (1 if angle >= 0 else -1) / (abs(angle) + (angle * angle + 1) ** 0.5)
                c = 1 / (t * t + 1) ** 0.5
                s = t * c
                for row in B:
                    row[p], row[q] = c * row[p] - s * row[q], s * row[p] + c * row[q]
                for M in (B, V):
                    M[p], M[q] = ([c * a - s * b for a, b in zip(M[p], M[q])],
                                  [s * a + c * b for a, b in zip(M[p], M[q])])
    return sorted(((B[i][i], V[i]) for i in range(n)), reverse=True)


def scaled(distances):
    """The first two principal coordinates, one row per landmark; None if a distance is unknown."""
    n = len(distances)
    known = [i for i in range(n) if sum(d != float("inf") for d in distances[i]) > 1]
    squares = [[distances[i][k] ** 2 for k in known] for i in known]
    m = len(known)
    if m < 3 or any(s == float("inf") for row in squares for s in row):
        return None
    means = [sum(row) / m for row in squares]
    mean = sum(means) / m
    B = [[-0.5 * (squares[i][k] - means[i] - means[k] + mean) for k in range(m)] for i in range(m)]
    (first, u), (second, v) = eigenpairs(B)[:2]
    rows = [None] * n
    for i, row in enumerate(known):
        rows[row] = [u[i] * first ** 0.5, v[i] * second ** 0.5]
    return rows


for line in iter(sys.stdin.buffer.readline, b""):
    request = json.loads(line)
    numbers = struct.iter_unpack(f"<{request['columns']}d", sys.stdin.buffer.read(request["bytes"]))
    rows = scaled(list(numbers))
    answer = {"id": request["id"]}
    answer |= {"coordinates": rows} if rows else {"error": "not all distances are known"}
    print(json.dumps(answer), flush=True)
