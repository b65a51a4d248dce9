# SPDX-License-Identifier: Apache-2.0
# bash completion of the command line program `cortex`: verbs, options, model files.
_cortex() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local verb=${COMP_WORDS[1]} verbs="validate diff types graph new-type new-system" options i
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$verbs --help --version" -- "$word")
        return
    fi
    case $verb in
        validate | diff) options="--json --help" ;;
        types) options="--file --json --help" ;;
        graph) options="--file --dot --json --help" ;;
        new-type) options="--extends --file --output --force --json --help" ;;
        new-system) options="--output --force --json --help" ;;
        *) return ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
        return
    fi
    # Names of types, from the files on the line or those of the installation.
    if [[ $before == --extends || $before == -e || ($verb == types && COMP_CWORD -eq 2) ]]; then
        local files=()
        for ((i = 2; i < ${#COMP_WORDS[@]}; ++i)); do
            [[ ${COMP_WORDS[i]} == *.xml && $i -ne $COMP_CWORD ]] && files+=("${COMP_WORDS[i]}")
        done
        ((${#files[@]})) || files=(robotics-morphology.xml)
        mapfile -t COMPREPLY < <(compgen -W "$("$1" types --file "${files[@]}" 2>/dev/null |
            sed -n 's/^ *\([A-Za-z0-9_-]*\).*/\1/p' | sort -u)" -- "$word")
        return
    fi
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -X '!*.xml' -- "$word"
        compgen -d -- "$word")
}
complete -F _cortex cortex
