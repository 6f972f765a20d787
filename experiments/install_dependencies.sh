#!/bin/sh
# Installs those Debian packages that halfstep needs and that are missing; arguments name further
# ones. Where none is missing it needs neither network nor rights.
set -eu

packages="g++ cmake ninja-build git pkg-config libeigen3-dev libfcl-dev liboctomap-dev liburdfdom-dev
  libconsole-bridge-dev libtinyxml-dev libpng-dev libyaml-cpp-dev libqhull-dev libsleef-dev libcli11-dev
  nlohmann-json3-dev libboost-dev libssl-dev libgtest-dev libgmock-dev libbenchmark-dev
  libcairo2-dev fonts-liberation coinor-libipopt-dev libnlopt-dev libceres-dev pybind11-dev python3-dev python3-numpy $*"

# For the report; a node from elsewhere does as well.
command -v npm >/dev/null || packages="$packages nodejs npm"

if ! command -v dpkg-query >/dev/null; then
  echo "Not a Debian system: the packages are left to you. Debian calls them" $packages >&2
  exit 0
fi
missing=""
for package in $packages; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -ne 0 ]; then
  echo "These packages are missing, and only root can install them. Run as root:" >&2
  echo "  apt-get install --no-install-recommends$missing" >&2
  exit 1
fi
echo "Installing$missing"
export DEBIAN_FRONTEND="${DEBIAN_FRONTEND:-noninteractive}"
apt-get update -qq
apt-get install -qq -y --no-install-recommends $missing >/dev/null
