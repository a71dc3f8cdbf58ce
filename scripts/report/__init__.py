"""Parts of scripts/report.py: from a results folder to one HTML page."""
