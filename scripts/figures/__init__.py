"""What scripts/figures.py draws: one module for each kind of figure."""
