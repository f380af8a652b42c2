"""How far a long test has come."""

import sys
import time


class Progress:
    """Says on standard error, twice a minute, how much of a long study is done and what it has found."""
    EVERY_S = 30.0

    def __init__(self, what, total):
        self.what, self.total = what, total
        self.start = self.told = time.monotonic()

    def at(self, done, found):
        now = time.monotonic()
        if now - self.told < self.EVERY_S or done == 0:
            return
        self.told = now
        left_min = (now - self.start) * (self.total - done) / done / 60
        print(f"{self.what}: {done} of {self.total}, {found} found, about {left_min:.0f} min left",
              file=sys.stderr, flush=True)
