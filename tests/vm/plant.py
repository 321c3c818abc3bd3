# SPDX-License-Identifier: Apache-2.0
"""Master and nodes under real-time priorities, and what becomes of a GPIO line when something fails."""


def steps(bench):
    return iter(())
