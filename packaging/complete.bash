
_tilelight() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} command=${COMP_WORDS[1]}
    local options shorts kind words option=
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "$_tilelight_commands help --help --version" -- "$word"))
        return
    elif [ "$command" = help ]; then
        COMPREPLY=($(compgen -W "$_tilelight_commands" -- "$word"))
        return
    fi
    _tilelight_options "$command"
    if [ "$word" = "=" ]; then # a word by itself, as COMP_WORDBREAKS has it
        option=$before word=
    elif [ "$before" = "=" ]; then
        option=${COMP_WORDS[COMP_CWORD - 2]}
    elif [[ " $options" = *" $before= "* || " $shorts" = *" $before "* ]]; then
        option=$before
    elif [[ "$word" = -* ]]; then
        COMPREPLY=($(compgen -W "$options" -- "$word"))
        [[ "${COMPREPLY[*]-}" != *= ]] || compopt -o nospace 2>/dev/null
        return
    fi
    _tilelight_value "$command" "$option"
    case $word in
        *,*) COMPREPLY=($(compgen -P "${word%,*}," -W "$words" -- "${word##*,}")) ;; # a list
        *) COMPREPLY=($(compgen -W "$words" -- "$word")) ;;
    esac
    case $kind in
        file) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- "$word") ;;
        folder) mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -d -- "$word") ;;
    esac
    [ -z "$kind" ] || compopt -o filenames 2>/dev/null
}
complete -F _tilelight tilelight
