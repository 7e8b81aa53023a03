"""The tables of docs/strategies.md, from the folder of a contest.

    python3 python/examples/contest_tables.py runs/contest

Prints scores, the figures beside them, and the differences of planners with the same seed: median (95 % interval) and
p after Holm's correction. The column `all` has the differences of totals, or of means.
"""

import sys

import numpy as np
import skein

# Figures of pairs.csv, and the format of their differences.
DIFFERENCES = {
    "score": ("Score", "{:+.0f}", "{:.0f}"),
    "mean_quality": ("Mean quality", "{:+.3f}", "{:.3f}"),
    "greatest_share": ("Greatest share of a UAV [%]", "{:+.0f}", "{:.0f}"),
    "idle_photographers_s": ("Idle photographers [s]", "{:+.0f}", "{:.0f}"),
    "score_deviation_percent": ("How far a score is from its planner's median [%]", "{:+.0f}", "{:.0f}"),
}


def print_table(head: list[str], rows: list[list[str]]) -> None:
    print("| " + " | ".join(head) + " |")
    print("|" + "---|" * len(head))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def spread(values: np.ndarray) -> str:
    return f"{np.median(values):.0f} ({values.min():.0f} to {values.max():.0f})"


def of(study: skein.Study, scenario: str, planner: str) -> np.ndarray:
    flights = study.flights
    return flights[(flights["scenario"] == scenario) & (flights["planner"] == planner)]


def print_scores(study: skein.Study) -> None:
    rows = []
    for scenario in study.scenarios:
        cells = [of(study, scenario, planner) for planner in study.planners]
        rows.append([scenario] + [f"{spread(cell['score'])}, {np.median(cell['attainable_percent']):.0f} %"
                                  for cell in cells])
    scores = {planner: sum(of(study, scenario, planner)["score"] for scenario in study.scenarios)
              for planner in study.planners}
    rows.append(["**total of a test**"] + [spread(scores[planner]) for planner in study.planners])
    print_table(["scene"] + [f"`{planner}`" for planner in study.planners], rows)


def print_figures(study: skein.Study) -> None:
    rows = []
    for scenario in study.scenarios:
        cells = [of(study, scenario, planner) for planner in study.planners]
        idle = [np.median(cell["idle_photographers_s"] / cell["mission_time_s"]) for cell in cells]
        rows.append([scenario,
                     " / ".join(f"{np.median(cell['mean_quality']):.2f}".lstrip("0") for cell in cells),
                     " / ".join(f"{100.0 * share:.0f}" for share in idle) + " %",
                     " / ".join(f"{np.median(cell['greatest_share']):.0f}" for cell in cells) + " %",
                     " / ".join(f"{100.0 * np.ptp(cell['score']) / np.median(cell['score']):.0f}" for cell in cells)
                     + " %",
                     " / ".join(f"{cell['without_work_s'].max():.0f}" for cell in cells) + " s"])
    print_table(["scene", "mean quality", "photographers idle", "greatest share of a UAV", "spread",
                 "without work, longest"], rows)


def print_differences(study: skein.Study, figure: str) -> None:
    title, median, bound = DIFFERENCES[figure]
    pairs = study.pairs[study.pairs["figure"] == figure]
    scenarios = [*study.scenarios, ""]
    rows = []
    for first, second in dict.fromkeys((str(pair["first"]), str(pair["second"])) for pair in pairs):
        row = [f"{first} - {second}"]
        for scenario in scenarios:
            found = pairs[(pairs["first"] == first) & (pairs["second"] == second) & (pairs["scenario"] == scenario)]
            if len(found) == 0 or not np.isfinite(found[0]["low"]):
                row.append("" if len(found) == 0 else median.format(found[0]["median"]))
                continue
            pair = found[0]
            interval = f"{bound.format(pair['low'])} to {bound.format(pair['high'])}"
            row.append(f"{median.format(pair['median'])} ({interval}), {pair['p_holm']:.3f}")
        rows.append(row)
    print(f"**{title}**\n")
    print_table([""] + study.scenarios + ["all"], rows)


def main() -> None:
    for folder in sys.argv[1:]:
        study = skein.Study(folder)
        flights = study.flights
        print(f"{len(flights)} flights, {int(flights['collisions'].sum())} collisions, "
              f"{int((flights['status'] != 'completed').sum())} not completed\n")
        print_scores(study)
        print_figures(study)
        for figure in DIFFERENCES:
            print_differences(study, figure)


if __name__ == "__main__":
    main()
