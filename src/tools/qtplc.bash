# SPDX-License-Identifier: Apache-2.0
# Completion of bash for qtplc: commands, options, and the signals of the master that the line
# names. Installed to share/bash-completion/completions/qtplc; from a build:
# source FOLDER/share/bash-completion/completions/qtplc
# The words come from "qtplc complete", so that they are those of the program that would run.
_qtplc() {
    local line=${COMP_LINE:0:COMP_POINT} words word prefix
    read -ra words <<< "$line"
    [[ $line == *[[:space:]] || ${#words[@]} -eq 0 ]] && words+=("")
    word=${words[-1]}
    # What bash calls the current word begins behind the last ':' or '='.
    prefix=${word%"${word##*[:=]}"}
    [[ $COMP_WORDBREAKS == *:* ]] || prefix=""
    COMPREPLY=()
    while IFS= read -r candidate; do
        COMPREPLY+=("${candidate#"$prefix"}")
    done < <("${words[0]/#\~/$HOME}" complete -- "${words[@]}" 2> /dev/null)
}
complete -F _qtplc qtplc
