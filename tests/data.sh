#!/bin/sh
# Fetches the published graphs that some tests read: 29 real graphs (the paper's Table 3) and five
# synthetic ones. They belong to their authors, who state no licence, so they are not part of this
# repository. Needs git; verifies every file by its SHA-256.
#
#     tests/data.sh FOLDER && VIEWCERT_DATA=FOLDER cargo test --workspace -- --ignored table_3
#
# The tests also read table1.csv, table2.csv and table3.csv there: the paper's printed tables,
# one line per row, behind the heads
#     nodes,edges,candidates,finite_solvable
#     density_percent,graphs,finite_solvable,components_min,components_max
#     name,file,nodes,density_percent,edges,components_edge_based,seconds_edge_based,components_node_based,seconds_node_based
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:?usage: tests/data.sh FOLDER}
source=https://github.com/federica-arrigoni/finite-solvability
mkdir -p "$folder/table3" "$folder/synthetic"
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
git clone --quiet --depth 1 "$source" "$clone"
while read -r sum path; do
    name=$(basename "$path")
    case $path in
    synthetic/*) from="$clone/GraphsSynthetic/$name" ;;
    *)
        from="$clone/GraphsReal/1DSFM_rigid/$name"
        [ -f "$from" ] || from="$clone/GraphsReal/PSFM/$name"
        ;;
    esac
    echo "$sum  $from" | sha256sum --check --quiet
    cp "$from" "$folder/$path"
done <"$here/data.sha256"
echo "34 graphs in $folder"
