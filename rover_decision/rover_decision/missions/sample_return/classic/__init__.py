"""The two classic solutions of this rover's task, with the rules of their documents and no others.

Each has a chart of its own, its rules as functions, what it remembers, and its states. See
docs/classics.md for the rules and where they stand.
"""
