"""What the Python tools of Tushar share."""
