#!/bin/sh
# Announces a block of a terabyte: the harness must refuse before it allocates.
printf 'Content-Length: 2\r\nBinary-Length: 1099511627776\r\n\r\n{}'
exec cat >/dev/null
