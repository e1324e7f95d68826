# The help of one command as a table, a record a line, fields parted by tabs. Variables: command, arguments,
# summary; layouts, the names of layouts. Reads `tilelight COMMAND --help`, an option a line
# (packaging/read-help).
#
#   command  NAME ARGUMENTS SUMMARY   of the list of commands
#   usage    NAME TEXT KIND WORDS     after the program's name; what arguments are
#   text     NAME LINE                before the options
#   group    NAME TITLE               that the options after it stand under; empty: none
#   option   NAME SHORT LONG ARGUMENT HOW KIND WORDS TEXT
#   note     NAME LINE                after the options
#
# Of an option: -x and --name, or empty; what its argument is called; none, one or optional; whether that is a
# file, a folder or neither (empty); the words among its values, parted by blanks; what it says.
BEGIN {
    OFS = "\t"
    print "command", command, arguments, summary
}

# Words that a value may be: in capitals are names of values, other words are values themselves.
function words_of_argument(argument,    count, parts, i, found) {
    if (argument !~ /[|]/ || argument ~ /=/)
        return ""
    count = split(argument, parts, /[| ]/)
    for (i = 1; i <= count; i++)
        if (parts[i] ~ /^[a-z0-9]+$/)
            found = found " " parts[i]
    return found
}

function kind_of(argument) {
    return argument ~ /FILE|\.(exr|json|png|cl|csv)/ ? "file" : argument ~ /DIR/ ? "folder" : ""
}

# "word: what it means." at the start of a sentence; "8, 16 or 32".
function words_of_text(text,    rest, word, found) {
    rest = text
    while (match(rest, /(^|[.)] )[a-z0-9][a-z0-9.-]*: /)) {
        word = substr(rest, RSTART, RLENGTH - 2)
        sub(/^[.)] /, "", word)
        found = found " " word
        rest = substr(rest, RSTART + RLENGTH - 1)
    }
    if (match(text, /([0-9]+, )+[0-9]+ or [0-9]+/)) {
        rest = substr(text, RSTART, RLENGTH)
        gsub(/,| or/, "", rest)
        found = found " " rest
    }
    if (text ~ /`tilelight layouts'/)
        found = found " " layouts
    return found
}

# The words that the program names as it refuses another: "...: one, other". It stops at the next option,
# which there is none of.
function words_of_refusal(option,    ask, line, found) {
    ask = "'" program "' " command " " option "=? --stop-here 2>&1"
    ask | getline line
    close(ask)
    if (!match(line, /"\?".*(; [a-z ]+: | is none of | there are )/))
        return ""
    found = substr(line, RSTART + RLENGTH)
    gsub(/,/, "", found)
    return found
}

# Each once.
function unique(words,    count, parts, i, seen, found) {
    count = split(words, parts, " ")
    for (i = 1; i <= count; i++)
        if (!seen[parts[i]]++)
            found = found (found == "" ? "" : " ") parts[i]
    return found
}

function print_option(head, text,    count, parts, i, short, long, argument, how, words) {
    short = long = argument = ""
    how = "none"
    count = split(head, parts, ", ")
    for (i = 1; i <= count; i++) {
        if (match(parts[i], /^(--[a-zA-Z0-9-]+|-.)/)) {
            if (substr(parts[i], 1, 2) == "--")
                long = substr(parts[i], 1, RLENGTH)
            else
                short = substr(parts[i], 1, RLENGTH)
            argument = substr(parts[i], RLENGTH + 1)
        }
    }
    if (argument != "")
        how = argument ~ /^\[/ ? "optional" : "one"
    gsub(/^\[=?|^[= ]|\]$/, "", argument)
    if (how == "one" && head ~ /\]$/)
        argument = argument "]"
    words = unique(words_of_argument(argument) " " words_of_text(text))
    if (words == "" && long != "" && argument ~ /^(NAME|SPACE|N)(,\.\.\.)?$/)
        words = words_of_refusal(long)
    print "option", command, short, long, argument, how, kind_of(argument), words, text
}

/^Usage: / {
    sub(/^Usage: tilelight [a-z]* ?/, "")
    rest = $0
    sub(/\[OPTION\.\.\.\] ?/, "", rest)
    words = words_of_argument(rest)
    if (rest ~ /^\[?NAME/ && command == "layouts")
        words = layouts
    print "usage", command, $0, (rest == "" || rest ~ /^\[?NAME/ ? "" : "file"), unique(words)
    next
}
/^Mandatory or optional arguments to long options/ { next }
/^ +-/ {
    has_options = 1
    match($0, /^ +-[^ ]*( [A-Z[][^ ]*|, --[^ ]*)?/)
    head = substr($0, 1, RLENGTH)
    text = substr($0, RLENGTH + 1)
    gsub(/^ +/, "", head)
    gsub(/^ +| +$/, "", text)
    if (text == "" && (getline text) > 0)
        gsub(/^ +| +$/, "", text)
    print_option(head, text)
    next
}
/^ [^ ].*:$/ {
    gsub(/^ |:$/, "")
    print "group", command, $0
    next
}
/^$/ && has_options { print "group", command, "" }
{ print has_options ? "note" : "text", command, $0 }
