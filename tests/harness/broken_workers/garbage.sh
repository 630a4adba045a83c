#!/bin/sh
# Speaks, but not the protocol.
echo "Hello, I am a physics engine."
exec cat >/dev/null
