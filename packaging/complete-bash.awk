# Completion for bash from the table that packaging/read-help prints, and packaging/complete.bash. Variable:
# driver, the latter.
BEGIN { FS = "\t" }

# Values of one kind, and words among them, of all options that have these: one branch. The arguments of a
# command are those of the option "".
function add_value(command, option, kind, words,    value) {
    value = kind "|" words
    if (value == "|")
        return
    if (!(value in patterns))
        values[++value_count] = value
    patterns[value] = patterns[value] (patterns[value] == "" ? "" : " | ") "'" command " " option "'"
}

$1 == "command" { commands = commands " " $2 }
$1 == "usage" { add_value($2, "", $4, $5) }
$1 == "option" {
    long = $4 == "" ? "" : $4 ($6 == "one" ? "= " : " ")
    short = $3 == "" ? "" : $3 " "
    options[$2] = options[$2] long short
    if ($6 == "one" && $3 != "")
        shorts[$2] = shorts[$2] short
    if ($6 != "none" && $3 != "")
        add_value($2, $3, $7, $8)
    if ($6 != "none" && $4 != "")
        add_value($2, $4, $7, $8)
}

END {
    print "# Completion of tilelight for bash. Made from the program's help by packaging/complete-bash.awk."
    print "\n_tilelight_commands='" substr(commands, 2) "'"
    print "\n# Sets options, and shorts, those of one letter with a value. Usage: COMMAND"
    print "_tilelight_options() {\n    options= shorts=\n    case $1 in"
    count = split(commands, names, " ")
    for (i = 1; i <= count; i++)
        printf "        %s)\n            options='%s'\n            shorts='%s'\n            ;;\n", names[i],
               options[names[i]], shorts[names[i]]
    print "    esac\n}\n\n# Sets kind and words of what a value may be. Usage: COMMAND OPTION"
    print "_tilelight_value() {\n    kind= words=\n    case \"$1 $2\" in"
    for (i = 1; i <= value_count; i++) {
        split(values[i], parts, "|")
        printf "        %s)\n            kind=%s words='%s'\n            ;;\n", patterns[values[i]], parts[1],
               parts[2]
    }
    print "    esac\n}"
    while ((getline line < driver) > 0)
        print line
}
