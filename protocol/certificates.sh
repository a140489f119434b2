#!/bin/sh
# Makes an authority of one's own and what it signs: a certificate for a daemon under the names by which clients find
# it, and one for a client.
#
#     protocol/certificates.sh DIRECTORY NAME-OR-ADDRESS...
#
# Keep authority-key.pem away from the network: whoever has it can make both.
set -eu
directory=$1
shift
mkdir -p "$directory"
cd "$directory"
umask 077

names=
for name in "$@"; do
  case $name in
    *[!0-9.]*) names="$names${names:+,}DNS:$name" ;;
    *) names="$names${names:+,}IP:$name" ;;
  esac
done

openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -days 3650 \
  -keyout authority-key.pem -out authority.pem -subj "/CN=spacetime authority" \
  -addext basicConstraints=critical,CA:TRUE -addext keyUsage=critical,keyCertSign

sign() {  # FILE PURPOSE EXTENSIONS
  openssl req -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes -keyout "$1-key.pem" -out "$1.csr" -subj "/CN=$1"
  printf '%s\n' "extendedKeyUsage=$2" "$3" > "$1.ext"
  openssl x509 -req -in "$1.csr" -CA authority.pem -CAkey authority-key.pem -days 825 -extfile "$1.ext" -out "$1.pem"
  rm "$1.csr" "$1.ext"
}
sign daemon serverAuth "subjectAltName=$names"
sign client clientAuth "keyUsage=digitalSignature"
