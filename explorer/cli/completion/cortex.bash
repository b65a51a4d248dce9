# SPDX-License-Identifier: Apache-2.0
# bash completion of the command line program `cortex`: verbs, options, model files, live paths.
_cortex() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]}
    local verb=${COMP_WORDS[1]} options i
    local network="--domain --interface --peer --discovery-server --security --timeout --json --help"
    local verbs="agents list show watch call set leases people shell events top save restore"
    verbs+=" conform doctor validate diff types graph new-type new-system security"
    COMPREPLY=()
    if ((COMP_CWORD == 1)); then
        mapfile -t COMPREPLY < <(compgen -W "$verbs --help --version" -- "$word")
        return
    fi
    case $verb in
        agents | list | show | leases | people | doctor) options=$network ;;
        call | set) options="--take --for $network" ;;
        shell) options="--name --keep-going ${network/--json /}" ;;
        top) options="--rate --seconds --once --until-gone $network" ;;
        save) options="--force $network" ;;
        conform)
            options="--move --speed --home --grip --seconds --junit --force --take --for $network"
            ;;
        restore) options="--dry-run --what-is-good --take --for $network" ;;
        watch) options="--rate --count --csv --labels $network" ;;
        events)
            options="--follow --since --until --before-fault --seconds --kind --severity --csv"
            options+=" $network"
            ;;
        validate | diff) options="--json --help" ;;
        types) options="--file $network" ;;
        graph) options="--file --dot $network" ;;
        new-type) options="--extends --file --output --force --json --help" ;;
        security)
            if ((COMP_CWORD == 2)); then
                mapfile -t COMPREPLY < <(compgen -W "create-authority create-agent show --help" \
                    -- "$word")
                return
            fi
            options="--authority --out --read-only --may-command --owns --domain --days --json --help"
            ;;
        new-system) options="--output --force --json --help" ;;
        *) return ;;
    esac
    if [[ $word == -* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
        return
    fi
    if [[ $verb =~ ^(agents|list|show|watch|call|set|events|top|conform|doctor)$ ]]; then
        _cortex_live "$@"
        return
    fi
    if [[ $verb == save && $COMP_CWORD -gt 2 ]]; then
        _cortex_live "$@"
        return
    fi
    if [[ $verb == shell ]]; then
        compopt -o filenames 2>/dev/null
        mapfile -t COMPREPLY < <(compgen -f -- "$word")
        return
    fi
    # Names of types, from the agents that are heard, the files on the line or the installation's.
    if [[ $before == --extends || $before == -e || ($verb == types && COMP_CWORD -eq 2) ]]; then
        local files=()
        for ((i = 2; i < ${#COMP_WORDS[@]}; ++i)); do
            [[ ${COMP_WORDS[i]} == *.xml && $i -ne $COMP_CWORD ]] && files+=("${COMP_WORDS[i]}")
        done
        if [[ $verb == types ]] && ((!${#files[@]})); then
            mapfile -t COMPREPLY < <(compgen -W "$("$1" types --timeout 1 2>/dev/null |
                sed -n 's/^ *\([A-Za-z0-9_-]*\).*/\1/p' | sort -u)" -- "$word")
            ((${#COMPREPLY[@]})) && return
        fi
        ((${#files[@]})) || files=(cortex-morphology.xml)
        mapfile -t COMPREPLY < <(compgen -W "$("$1" types --file "${files[@]}" 2>/dev/null |
            sed -n 's/^ *\([A-Za-z0-9_-]*\).*/\1/p' | sort -u)" -- "$word")
        return
    fi
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -f -X '!*.xml' -- "$word"
        compgen -d -- "$word")
}

# Paths of the agents that are heard, commands of the simplex on the line.
_cortex_live() {
    local word=${COMP_WORDS[COMP_CWORD]} network=() i
    for ((i = 2; i < COMP_CWORD; ++i)); do
        [[ ${COMP_WORDS[i]} =~ ^--(domain|interface|peer|discovery-server|security)$ ]] &&
            network+=("${COMP_WORDS[i]}" "${COMP_WORDS[i + 1]}")
    done
    if [[ ${COMP_WORDS[1]} == call && $COMP_CWORD -eq 3 ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$1" show "${COMP_WORDS[2]}" --timeout 1 \
            "${network[@]}" 2>/dev/null | sed -n '/^commands/,$s/^  \([A-Za-z0-9_-]*\).*/\1/p')" \
            -- "$word")
    elif [[ ${COMP_WORDS[1]} == set && $COMP_CWORD -ge 3 ]] ||
        [[ ${COMP_WORDS[1]} == call && $COMP_CWORD -ge 4 ]]; then
        _cortex_names "$@"
    elif [[ ${COMP_WORDS[1]} == watch && $word == *.* ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$1" show "${word%%.*}" --timeout 1 \
            "${network[@]}" 2>/dev/null |
            sed -n "/^data/,/^$/s|^  \([A-Za-z0-9_-]*\).*|${word%%.*}.\1|p")" -- "$word")
    elif [[ ${COMP_WORDS[1]} != agents && ${COMP_WORDS[1]} != doctor ]]; then
        mapfile -t COMPREPLY < <(compgen -W "$("$1" list --timeout 1 "${network[@]}" 2>/dev/null |
            sed 's/ .*//')" -- "$word")
    fi
}
# Parameters of the command on the line, as `name=`.
_cortex_names() {
    local command=set names
    [[ ${COMP_WORDS[1]} == call ]] && command=${COMP_WORDS[3]}
    names=$("$1" show "${COMP_WORDS[2]}" --timeout 1 "${network[@]}" 2>/dev/null |
        sed -n "/^commands/,\$s/^  $command  *//p" | grep -o '[A-Za-z0-9_-]*=')
    mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
    compopt -o nospace 2>/dev/null
}
complete -F _cortex cortex
