#!/bin/sh
# Ends at once, as a program does whose shared library is gone.
echo "cannot load libengine.so" >&2
exit 127
