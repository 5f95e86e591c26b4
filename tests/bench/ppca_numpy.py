"""The greatest likelihood of PPCA with missing entries, found by numpy and scipy alone: a general
optimiser over W, mean and noise, from many starts, of the density of each column's observed
entries. The numbers stand in tests/core/missing/ppca_test.cpp."""

import numpy as np
from scipy.optimize import minimize

M, C, Q = 6, 40, 2


def data():
    i, c = np.meshgrid(np.arange(M), np.arange(C), indexing="ij")
    values = np.sin(0.7 * i + 0.3 * c) + 0.5 * np.cos(0.11 * i * c) + 0.1 * np.sin(1.7 * i * c + c)
    return values, (7 * i + 3 * c) % 5 != 0


def unpacked(z):
    return z[: M * Q].reshape(M, Q), z[M * Q : M * Q + M], np.exp(z[-1])


def loss(z, values, seen):
    loadings, mean, noise = unpacked(z)
    covariance = loadings @ loadings.T + noise * np.eye(M)
    total = 0.0
    for c in range(C):
        rows = seen[:, c]
        part = covariance[np.ix_(rows, rows)]
        left = values[rows, c] - mean[rows]
        total += 0.5 * (rows.sum() * np.log(2 * np.pi) + np.linalg.slogdet(part)[1]
                        + left @ np.linalg.solve(part, left))
    return total


def main():
    values, seen = data()
    rng = np.random.default_rng(1)
    best = None
    for _ in range(6):
        start = np.concatenate([rng.normal(size=M * Q + M), [-1.0]])
        found = minimize(loss, start, args=(values, seen), method="L-BFGS-B",
                         options={"maxiter": 3000, "maxfun": 10**6, "ftol": 1e-14, "gtol": 1e-9})
        print(f"log likelihood {-found.fun:.6f} noise {np.exp(found.x[-1]):.6f}")
        if best is None or found.fun < best.fun:
            best = found
    loadings, mean, noise = unpacked(best.x)
    print(f"best {-best.fun:.6f} noise {noise:.6f} mean {mean.round(5)}")
    print("W W' diagonal", np.sum(loadings**2, axis=1).round(5))


if __name__ == "__main__":
    main()
