# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes wrong, in one line."""


class Error(Exception):
    """A document that is no results document, or a program that could not do what it was asked for.

    `status` is the program's exit status: 2 the input is wrong, 3 the program or the machine failed, below 0 a signal
    ended it; None where no program ran.
    """

    def __init__(self, message, status=None):
        super().__init__(message)
        self.status = status
