# Manual pages of the table that packaging/read-help prints: tilelight.1 and one for each command. Variable:
# out, the folder that they go to.
BEGIN { FS = "\t" }

# As troff takes it; `...' in bold.
function escape(text,    parts, count, i, rest) {
    gsub(/\\/, "\\e", text)
    gsub(/-/, "\\-", text)
    while (match(text, /`[^`']*'/))
        text = substr(text, 1, RSTART - 1) "\\fB" substr(text, RSTART + 1, RLENGTH - 2) "\\fR" \
               substr(text, RSTART + RLENGTH)
    return text
}

# A line of text, or nothing between paragraphs.
function paragraph(text) {
    text = escape(text)
    if (text == "")
        print ".PP" > page
    else
        print (text ~ /^[.']/ ? "\\&" : "") text > page
}

function section(title) {
    print ".SH " toupper(title) > page
}

function begin_page(name, summary) {
    page = out "/" name ".1"
    print ".\\\" Made from the program's help by packaging/manual.awk." > page
    print ".TH " toupper(escape(name)) " 1 \"\" \"tilelight " version "\" \"tilelight\"" > page
    section("name")
    print escape(name " - " summary) > page
    section("synopsis")
}

# What lists of values say of each, one under the other. Usage: text, words as in the table
function explain(text, words,    count, parts, i, word, at, starts) {
    count = split(words, parts, " ")
    for (i = 1; i <= count; i++) {
        word = parts[i] ": "
        at = index(text, ". " word) ? index(text, ". " word) : index(text, ") " word)
        if (at == 0 && index(text, word) != 1)
            continue
        paragraph(substr(text, 1, at))
        if (!starts++)
            print ".RS" > page
        print ".TP\n.B " escape(parts[i]) > page
        text = substr(text, at + length(word) + (at > 0 ? 2 : 1))
    }
    paragraph(text)
    if (starts)
        print ".RE" > page
}

function describe_option(short, long, argument, how, words, text,    head, value) {
    value = "\\fI" escape(argument) "\\fR"
    if (short != "")
        head = "\\fB" escape(short) "\\fR" (long == "" && how == "one" ? " " value : "")
    if (long != "") {
        head = head (head == "" ? "" : ", ") "\\fB" escape(long) "\\fR"
        head = head (how == "one" ? "=" value : how == "optional" ? "[=" value "]" : "")
    }
    print ".TP\n" head > page
    explain(text, words)
}

$1 == "version" { version = $2 }

# The program's own: the list of commands comes from the table.
$1 == "program" && /\tUsage: / {
    begin_page("tilelight", "capture glTF scenes into G-buffers and light them with OpenCL")
    program = page
    print ".B tilelight\n" escape(substr($2, 18)) > page
    section("description")
    next
}
$1 == "program" && $2 ~ /^Commands/ {
    section("commands")
    paragraph("Each has a page of its own: `man tilelight COMMAND'.")
    in_list = 1
    next
}
$1 == "program" && $2 == "" && in_list { in_list = 0; section("environment"); next }
$1 == "program" && in_list {
    sub(/^ +/, "", $2)
    count = split($2, columns, /   */)
    print ".TP\n\\fBtilelight " columns[1] "\\fR " (count == 3 ? escape(columns[2]) : "") > page
    paragraph(columns[count])
    next
}
$1 == "program" && $2 ~ /^Exit status:/ { section("exit status"); in_statuses = 1; next }
$1 == "program" && in_statuses {
    print $2 ~ /^  [0-9]/ ? ".TP\n.B " substr($2, 3, 1) : ".br" > page
    paragraph(substr($2, 6))
    next
}
$1 == "program" { paragraph($2) }

$1 == "command" {
    begin_page("tilelight-" $2, $4)
    pages = pages (pages == "" ? "" : ",\n") ".BR tilelight\\-" $2 " (1)"
}
$1 == "usage" {
    print ".B tilelight " $2 "\n" escape($3) > page
    section("description")
}
$1 == "text" { paragraph($3) }
$1 == "group" {
    title = $3
    pending = 1
}
$1 == "option" {
    if (!(page in with_options)) {
        with_options[page] = 1
        section("options")
    }
    if (pending && title != "")
        print ".SS \"" escape(title) "\"" > page
    pending = 0
    describe_option($3, $4, $5, $6, $8, $9)
}
$1 == "note" && $3 == "" && !(page in with_notes) { next }
$1 == "note" {
    if (!(page in with_notes)) {
        with_notes[page] = 1
        section("notes")
    }
    paragraph($3)
}

function end_page(name, see) {
    page = name
    section("see also")
    print see "\n.PP\nPages of docs/ are in\n.I share/doc/tilelight\nof the prefix." > page
    close(page)
}
END {
    end_page(program, pages)
    for (name in with_options)
        end_page(name, ".BR tilelight (1)")
}
