#!/usr/bin/env bash
# Simulates and draws docs/scale.svg again: docs/scale.sh BIN-DIRECTORY
#   MESSAGE_US=6 LATENCY_MS=1   what a message costs rank 0, and how long it is on its way (docs/scale.md)
# Takes some minutes. The figures go to out/scale.json.
set -euo pipefail
bin=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p out
farm() { # NAME TIMES MOST-WORKERS
  local workers=100 more
  for more in 200 500 1000 2000 5000 10000 20000 50000 100000; do ((more > $3)) || workers+=", $more"; done
  echo "{\"cell_times\": \"bench/data/cell_times_$1.txt\", \"times\": $2, \"workers\": [$workers], \"cells_per_worker\": 250,
    \"message_us\": ${MESSAGE_US:-6}, \"latency_ms\": ${LATENCY_MS:-1}}"
}
echo "{\"farms\": [$(farm linz 1 100000), $(farm denhaag 1 100000), $(farm houses 1 100000), $(farm denhaag 0.02 20000)]}" |
  "$bin/veduta-bench-leases" >out/scale.json

awk '
  function x(workers) { return 60 + 250 * log(workers / 100) / log(10) }
  function y(share) { return 360 - 320 * share }
  function text(at_x, at_y, kind, what) { printf "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\">%s</text>\n", kind, at_x, at_y, what }
  /"cell_times"/ { split($0, part, /cell_times_|\.txt/); city = part[2] }
  /"times"/ { gsub(/,/, ""); if ($2 < 1) city = city " fast" }
  /"workers"/ { gsub(/,/, ""); workers = $2 }
  /"efficiency"/ {
    gsub(/,/, "")
    if (!(city in line)) order[++cities] = city
    line[city] = line[city] sprintf("%.1f,%.1f ", x(workers), y($2))
    marks[city] = marks[city] sprintf("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\"/>", x(workers), y($2))
  }
  END {
    name["linz"] = "Linz, 858 ms a cell"; name["denhaag"] = "Den Haag, 621 ms"
    name["houses"] = "houses, 132 ms"; name["denhaag fast"] = "Den Haag 50 times as fast, 12 ms"
    print "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"860\" height=\"420\" viewBox=\"0 0 860 420\" role=\"img\">"
    print "<title>Efficiency of a farm with one coordinator against its workers</title>"
    print "<style>"
    print "text{font:12px system-ui,-apple-system,\"Segoe UI\",Roboto,Arial,sans-serif;fill:#222}"
    print ".title{font-size:15px;font-weight:600}.tick{fill:#666;font-size:11.5px}.middle{text-anchor:middle}.end{text-anchor:end}"
    print ".grid{stroke:#e4e4e4}.mark{stroke:#888;stroke-dasharray:5 3}.paper{fill:#fff}"
    print "polyline{fill:none;stroke:currentColor;stroke-width:1.8}circle{fill:currentColor}.key{fill:currentColor}"
    print ".c1{color:#0072b2}.c2{color:#d55e00}.c3{color:#009e73}.c4{color:#a23b86}"
    print "@media screen and (prefers-color-scheme:dark){text{fill:#e6e6e6}.tick{fill:#9aa0a6}.grid{stroke:#2b3036}.paper{fill:#15181b}"
    print ".c1{color:#56b4e9}.c2{color:#ff8f40}.c3{color:#2fd3a5}.c4{color:#e08cc0}.key{fill:currentColor}}"
    print "</style>"
    print "<rect class=\"paper\" width=\"860\" height=\"420\"/>"
    text(60, 22, "title", "Efficiency of a farm with one coordinator, 250 cells a worker (simulated)")
    for (share = 0; share <= 1.001; share += 0.25) {
      printf "<line class=\"grid\" x1=\"60\" x2=\"820\" y1=\"%.1f\" y2=\"%.1f\"/>\n", y(share), y(share)
      text(52, y(share) + 4, "tick end", sprintf("%d %%", 100 * share))
    }
    printf "<line class=\"mark\" x1=\"60\" x2=\"820\" y1=\"%.1f\" y2=\"%.1f\"/>\n", y(0.95), y(0.95)
    text(824, y(0.95) + 4, "tick", "95 %")
    split("100 200 500 1000 2000 5000 10000 20000 50000 100000", tick, " ")
    for (i = 1; i <= 10; i++) {
      printf "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"40\" y2=\"360\"/>\n", x(tick[i]), x(tick[i])
      text(x(tick[i]), 378, "tick middle", tick[i])
    }
    text(440, 402, "middle", "workers")
    for (i = 1; i <= cities; i++) {
      printf "<g class=\"c%d\"><polyline points=\"%s\"/>%s", i, line[order[i]], marks[order[i]]
      printf "<circle cx=\"88\" cy=\"%.1f\" r=\"4\"/>", 236 + 22 * i
      text(100, 240 + 22 * i, "key", name[order[i]])
      print "</g>"
    }
    print "</svg>"
  }' out/scale.json >docs/scale.svg
