# Completion for fish from the table that packaging/read-help prints.
BEGIN {
    FS = "\t"
    print "# Completion of tilelight for fish. Made from the program's help by packaging/complete-fish.awk."
    print "complete -c tilelight -f"
    print "complete -c tilelight -n __fish_use_subcommand -a help -d 'what a command takes'"
}

# The first clause, in quotes.
function brief(text) {
    sub(/(\. | \(|; ).*/, "", text)
    return quoted(text)
}
function quoted(text) {
    gsub(/\\/, "\\\\", text)
    gsub(/'/, "\\'", text)
    return "'" text "'"
}
function value(kind, words) {
    return (kind == "" ? " -f" : kind == "folder" ? " -f -a '(__fish_complete_directories)'" : " -F") \
           (words == "" ? "" : " -a " quoted(words))
}

$1 == "command" {
    print "complete -c tilelight -n '__fish_use_subcommand; or __fish_seen_subcommand_from help' -a " $2 \
          " -d " brief($4)
    for_this = "complete -c tilelight -n '__fish_seen_subcommand_from " $2 "'"
}
$1 == "usage" { print for_this value($4, $5) }
$1 == "option" {
    print for_this ($3 == "" ? "" : " -s " quoted(substr($3, 2))) ($4 == "" ? "" : " -l " substr($4, 3)) \
          ($6 == "one" ? " -r" : "") ($6 == "none" ? "" : value($7, $8)) " -d " brief($9)
}
