"""Processor time, with a limit: the wall clock would measure the others who use the machine."""

import time


class OutOfTime(Exception):
    """The limit has passed."""


class Clock:
    """Counts the calls of functions, the time inside them, and all time since its start."""

    def __init__(self, limit):
        self.limit = limit
        self.inside, self.calls = 0.0, {}
        self.restart()

    def restart(self):
        """Leaves out what went before: the building of the system."""
        self.start = time.process_time()

    def __call__(self, name, function, *arguments):
        start = time.thread_time()
        result = function(*arguments)
        self.inside += time.thread_time() - start - EMPTY
        self.count(name)
        return result

    def count(self, name, calls=1):
        self.calls[name] = self.calls.get(name, 0) + calls

    def whole(self):
        return time.process_time() - self.start

    def check(self):
        """Raises `OutOfTime` past the limit."""
        if self.whole() > self.limit:
            raise OutOfTime


def _empty_call():
    """What the clock reads of a call that does nothing: the least of many."""
    least = float("inf")
    for _ in range(2000):
        start = time.thread_time()
        least = min(least, time.thread_time() - start)
    return least


EMPTY = _empty_call()
