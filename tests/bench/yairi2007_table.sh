#!/bin/sh
# Prints timings.jsonl of a study and what scripts/bench yairi2007 measured beside it as a table:
# yairi2007_table.sh TIMINGS RESULTS
# Seconds by the item are means: ours over the very maps that python made, too, if it ran.
awk '
  function field(name,    at) {
    if (!match($0, "\"" name "\": \"?[^,\"}]*")) return ""
    at = substr($0, RSTART, RLENGTH)
    sub(/^"[^"]*": "?/, "", at)
    return at
  }
  function parameter(    value) {
    value = field("K") field("sigma2") field("d")
    return value == "" ? "-" : value + 0
  }
  function cell(value, format) { return value == "" ? "-" : sprintf(format, value) }
  function row(name, count, ours, our_total, items, theirs, their_total) {
    printf "%-40s %6d %11s %9s %6s %11s %9s %7s\n", name, count, cell(ours, "%.6f"),
           cell(our_total, "%.3f"), cell(items, "%d"), cell(theirs, "%.6f"),
           cell(their_total, "%.2f"),
           ours == "" || theirs == "" ? "-" : sprintf("%.1f", theirs / ours)
  }
  # A part of the protocol that only python times by itself.
  function part_row(name, count) {
    if (!(name in part)) return
    row("  " name, count, "", "", times[name], part[name], part[name] * count)
    their_rest += part[name] * count
  }

  FILENAME == ARGV[1] && /"kind": "map"/ {
    item = field("layout") " " field("pose") " " field("sensor") " " field("step") " " \
           field("method") " " parameter()
    seconds[item] = field("seconds")
    kind = field("sensor") " " field("method")
    if (!(kind in count)) kinds[++n] = kind
    ++count[kind]
    total[kind] += seconds[item]
    maps += seconds[item]
    ++map_count
    if (!(field("layout") " " field("pose") in run)) ++runs
    run[field("layout") " " field("pose")] = 1
    checkpoint = field("layout") " " field("pose") " " field("sensor") " " field("step")
    if (!(checkpoint in seen)) ++checkpoints
    seen[checkpoint] = 1
    next
  }
  FILENAME == ARGV[1] { next }
  $1 == "load" { load = $2 }
  $1 == "ours" { wall[$2] = $3; processor[$2] = $4; peak[$2] = $5; order[++measured] = $2 }
  $1 == "count" { figures = $3 }
  $1 == "note" { notes[++note_count] = substr($0, 6) }
  $1 == "part" { times[$2] = $4; part[$2] = $3 / $4; python = 1 }
  $1 == "map" {
    item = $2 " " $3 " " $4 " " $5 " " $6 " " ($7 == "-" ? "-" : $7 + 0)
    kind = $4 " " $6
    ++matched[kind]
    matched_ours[kind] += seconds[item]
    matched_theirs[kind] += $8
  }

  END {
    printf "load average at the start: %s\n\n", load
    printf "%-40s %9s %12s %9s\n", "mapproof, whole and in steps", "wall s", "processor s",
           "peak MiB"
    for (i = 1; i <= measured; ++i) {
      name = order[i]
      label = name
      if (name == "run") label = "run, 1 thread"
      if (name == "report") label = "report, 1 thread"
      if (sub(/^whole-/, "", label)) label = "reproduce, " label " threads"
      printf "%-40s %9.2f %12.2f %9s\n", label, wall[name], processor[name],
             peak[name] == "-" ? "-" : sprintf("%.0f", peak[name] / 1024)
    }
    printf "\n%-40s %6s %11s %9s %6s %11s %9s %7s\n", "one thread", "count", "ours s/item",
           "ours s", "tried", "python s/it", "python s*", "times"
    for (i = 1; i <= n; ++i) {
      kind = kinds[i]
      ours = total[kind] / count[kind]
      theirs = their_total = ""
      if (matched[kind]) {
        ours = matched_ours[kind] / matched[kind]
        theirs = matched_theirs[kind] / matched[kind]
        their_total = theirs * count[kind]
        their_maps += their_total
      }
      row(kind, count[kind], ours, total[kind], matched[kind], theirs, their_total)
    }
    row("all maps", map_count, maps / map_count, maps, "", python ? their_maps / map_count : "",
        python ? their_maps : "")
    part_row("simulation", runs)
    part_row("observation,_visibility", runs)
    part_row("observation,_bearing", runs)
    part_row("distances", checkpoints)
    part_row("scores", map_count)
    part_row("records", map_count)
    rest = wall["run"] - maps
    row("simulation to records, by the run", runs, rest / runs, rest, "",
        python ? their_rest / runs : "", python ? their_rest : "")
    row("figures, report", figures, wall["report"] / figures, wall["report"], times["figures"],
        part["figures"], python ? part["figures"] * figures : "")
    ours = wall["run"] + wall["report"]
    if (python) {
      theirs = their_maps + their_rest + part["figures"] * figures
      row("the whole protocol", 1, ours, ours, "", theirs, theirs)
      print "\n* python: seconds by the item, measured on as many as \"tried\" says, times the count"
      print "  of the full protocol. It makes no report around its figures."
    } else {
      row("the whole protocol", 1, ours, ours)
    }
    for (i = 1; i <= n; ++i)
      if (total[kinds[i]] > most) { most = total[kinds[i]]; top = kinds[i] }
    printf "\nOf our %.2f s one thread spends %.0f %% on maps (most on %s, %.0f %%), %.0f %% on",
           ours, 100 * maps / ours, top, 100 * most / ours, 100 * rest / ours
    printf " simulation, distances,\nscores and records, %.0f %% on figures and report.\n",
           100 * wall["report"] / ours
    for (i = 1; i <= note_count; ++i) print notes[i]
  }' "$1" "$2"
