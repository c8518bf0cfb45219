"""tests/truth/source_tables.py - tables of numbers as they stand in the sources."""
# SPDX-License-Identifier: MIT

import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
from harness import ROOT


def table(path, name, columns=1):
    """Its rows of so many numbers; of one column the numbers."""
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        body = re.search(r"\b" + name + r"\[[^=]*= \{\n(.*?)\n\};", file.read(), re.S).group(1)
    numbers = [float(word) for word in re.findall(r"-?\d[\d.]*(?:e-?\d+)?", body)]
    if columns == 1:
        return numbers
    return [numbers[i:i + columns] for i in range(0, len(numbers), columns)]
