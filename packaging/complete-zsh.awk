# Completion for zsh from the table that packaging/read-help prints.
BEGIN { FS = "\t" }

function quoted(text) {
    gsub(/'/, "'\\''", text)
    return "'" text "'"
}
# The first clause, as between brackets.
function brief(text) {
    sub(/(\. | \(|; ).*/, "", text)
    gsub(/[][\\]/, "\\\\&", text)
    return "[" text "]"
}
# ":what it is:how it is completed"
function value(name, kind, words) {
    gsub(/:/, "\\:", name)
    if (kind != "" && words != "")
        return ":" name ":{compadd " words "; _files}"
    if (words != "")
        return ":" name ":(" words ")"
    return ":" name ":" (kind == "folder" ? "_files -/" : kind == "file" ? "_files" : " ")
}

# One more of a branch.
function add(spec) {
    branches = branches " \\\n                " quoted(spec)
}

$1 == "command" {
    text = $4
    gsub(/:/, "\\:", text)
    commands = commands "        " quoted($2 ":" text) "\n"
    branches = branches (branches == "" ? "" : " ;;\n") "        " $2 ")\n            _arguments -s :"
}
$1 == "usage" { add("*" ($4 $5 == "" ? ": : " : value($3, $4, $5))) }
$1 == "option" {
    rest = brief($9) ($6 == "none" ? "" : ($6 == "optional" ? ":" : "") value($5, $7, $8))
    often = $9 ~ /given (for each|several times)/ ? "*" : ""
    if ($3 != "")
        add(often $3 ($6 == "one" ? "+" : $6 == "optional" ? "-" : "") rest)
    if ($4 != "")
        add(often $4 ($6 == "one" ? "=" : $6 == "optional" ? "=-" : "") rest)
}

END {
    print "#compdef tilelight"
    print "# Completion of tilelight for zsh. Made from the program's help by packaging/complete-zsh.awk."
    print "local curcontext=$curcontext state line ret=1\nlocal -a commands\ncommands=("
    printf "%s)\n", commands "        " quoted("help:what a command takes") "\n"
    print "_arguments -C '1:command:->command' '*::argument:->argument' && ret=0"
    print "case $state in\n    command) _describe command commands && ret=0 ;;"
    print "    argument)\n        case $words[1] in\n        help) _describe command commands ;;"
    print branches " ;;\n        esac && ret=0 ;;\nesac\nreturn ret"
}
