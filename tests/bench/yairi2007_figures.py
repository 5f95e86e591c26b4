"""Maps and error curves with matplotlib, each as PNG, SVG and PDF of the size of mapproof's."""
import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot

STYLES = ["o-", "s--", "^-.", "D:"]


def finished(figure, axes, stem, **words):
    axes.set(**words)
    axes.grid(color="#e4e4e4")
    axes.set_axisbelow(True)
    axes.legend(loc="best")
    for ending in ("png", "svg", "pdf"):
        figure.savefig(f"{stem}.{ending}")
    pyplot.close(figure)


def draw_map(ground_truth, estimate, stem):
    figure, axes = pyplot.subplots(figsize=(8, 6), dpi=150)
    ends = [[ground_truth[:, k], estimate[:, k]] for k in (0, 1)]
    axes.plot(*ends, color="#757575", linewidth=1.2)
    axes.plot(*ground_truth.T, "o", mfc="white", mec="#1a1a1a", markersize=6, label="true position")
    axes.plot(*estimate.T, "o", color="#0072b2", markersize=5, label="estimate")
    axes.set_aspect("equal")
    finished(figure, axes, stem, title="Map, 2000 steps", xlabel="x [m]", ylabel="y [m]")


def draw_curves(maps, stem):
    """Four methods' errors over ten checkpoints, made up from the errors that were found."""
    errors = [record["score"]["mpe_m"] for record in maps]
    steps = range(200, 2001, 200)
    figure, axes = pyplot.subplots(figsize=(8, 6), dpi=150)
    for number, style in enumerate(STYLES):
        mean = [errors[(10 * number + k) % len(errors)] for k in range(10)]
        axes.fill_between(steps, [0.8 * value for value in mean], [1.2 * value for value in mean],
                          alpha=0.2, linewidth=0)
        axes.plot(steps, mean, style, label=f"method {number + 1}")
    finished(figure, axes, stem, title="Mean position error over observations",
             xlabel="observations (steps)", ylabel="MPE [m]")
