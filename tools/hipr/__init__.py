"""The `hipr` command: set-up, build, render and test of hdHipr. Python standard library only."""
