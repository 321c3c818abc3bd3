# SPDX-License-Identifier: Apache-2.0
"""What was measured, as Markdown."""
from .programs import REFERENCE, SECOND


def show(value, digits=1):
    return "-" if value is None else f"{value:.{digits}f}"


def table(head, rows):
    return "\n".join(
        ["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows)]
    )


def reach_table(rows):
    return table(
        ["what", "reach", "seen", "met"],
        [
            [row.what, f"{row.bound} {row.reach:g}", show(row.seen, row.digits), "yes" if row.met else "**no**"]
            for row in rows
        ],
    )


def program_table(results, mode, slaves, paced):
    head = [
        "program",
        "p50 µs, best (median)",
        "p99",
        "CPU µs, best",
        f"p50, x {REFERENCE}",
        f"p50, x {SECOND}",
        "CPU, x " + SECOND,
        "bytes per slave",
    ]
    head += ["late p50", "late p99", "missed %"] if paced else []
    head += ["rounds (noisy)"]
    names = sorted(results.names(mode, slaves), key=lambda name: results.best(mode, slaves, name, "rtt_p50_us"))
    return table(head, [program_row(results, mode, slaves, name, paced) for name in names])


def program_row(results, mode, slaves, name, paced):
    runs = results.of(mode, slaves, name)
    bytes_per_cycle = results.median(mode, slaves, name, "bytes_per_cycle")
    cells = [
        f"**{name}**" if name.startswith("qtplc/") else name,
        f"{show(results.best(mode, slaves, name, 'rtt_p50_us'))} "
        f"({show(results.median(mode, slaves, name, 'rtt_p50_us'))})",
        show(results.median(mode, slaves, name, "rtt_p99_us")),
        show(results.best(mode, slaves, name, "cpu_total_us")),
        show(results.ratio(mode, slaves, name, REFERENCE, "rtt_p50_us"), 2),
        show(results.ratio(mode, slaves, name, SECOND, "rtt_p50_us"), 2),
        show(results.ratio(mode, slaves, name, SECOND, "cpu_total_us"), 2),
        show(None if bytes_per_cycle is None else bytes_per_cycle / slaves, 0),
    ]
    if paced:
        cells += [show(results.median(mode, slaves, name, f"late_{key}_us")) for key in ("p50", "p99")]
        cells.append(show(100 * results.missed(mode, slaves, name), 2))
    return [*cells, f"{len(runs)} ({sum(run['noisy'] for run in runs)})"]


def wake_up_table(wake_ups):
    rows = []
    for wake_up in wake_ups:
        for name, figures in wake_up["figures"].items():
            rows.append(
                [
                    f"{wake_up['period_us'] / 1000:g} ms, SCHED_{wake_up['policy'].upper()}",
                    name,
                    *(show(figure) for figure in figures),
                ]
            )
    return table(["period", "program", "p50 µs, best", "p99, best", "p50, median", "p99, median"], rows)


def calls_line(who, calls):
    return (
        f"- {who}: {sum(calls.values()):.2f} (" + ", ".join(f"{name} {rate:.2f}" for name, rate in calls.items()) + ")"
    )


def markdown(measured, results, rows):
    parts = [
        f"Measured on {measured['machine']}; load average {measured['load']}. "
        f"{results.noisy()} of {len(results.all)} runs were noisy: "
        f"others used more than {measured['quiet']:g} CPUs meanwhile."
    ]
    if results.noisy() * 4 > len(results.all):
        parts.append(
            "**The machine was noisy**: absolute times are upper bounds, and ratios are those of the best rounds."
        )
    if rows:
        parts += ["### What is reached", reach_table(rows)]
    for mode in dict.fromkeys(run["mode"] for run in results.all):
        for slaves in sorted({run["slaves"] for run in results.all if run["mode"] == mode}):
            paced = any(run["period_us"] for run in results.all if run["mode"] == mode)
            parts += [
                f"### {mode[0].upper()}{mode[1:]}, {slaves} slave{'s' if slaves > 1 else ''}",
                program_table(results, mode, slaves, paced),
            ]
    if measured.get("rates"):
        parts += [
            "### Highest rate with at most 1 % of the cycles missed, SCHED_FIFO, 10 slaves",
            table(["program", "Hz"], [[name, show(rate, 0)] for name, rate in measured["rates"].items()]),
        ]
    if measured.get("wake_ups"):
        parts += ["### Lateness of the wake-up", wake_up_table(measured["wake_ups"])]
    if measured.get("system_calls"):
        parts += [
            "### System calls per cycle, UDP, 10 slaves",
            "\n".join(calls_line(who, measured["system_calls"][who]) for who in ("master", "slave")),
        ]
    if measured.get("failures"):
        parts += ["### Not measured", "\n".join(f"- {name}: {text}" for name, text in measured["failures"].items())]
    return "\n\n".join(parts) + "\n"
