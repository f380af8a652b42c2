"""What scripts/check_layers.py is made of: the rules, the sources, circles, and CMake's lists."""
