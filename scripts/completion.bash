# Completes verbs, options and files of edgescout in bash. The program itself says what there is.
_edgescout() {
  local current=${COMP_WORDS[COMP_CWORD]} program=${COMP_WORDS[0]} words=() word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ $word == -* ]] && break
    words+=("$word")
    # `model` and `bench` have verbs of their own; others take files.
    [[ ${words[0]} == model || ${words[0]} == bench ]] || break
  done
  local help
  help=$("$program" "${words[@]}" --help-all 2>/dev/null) || return
  if [[ $current == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$(grep -oE -- '^ *(-[a-zA-Z],)?--[a-z0-9-]+(,--[a-z0-9-]+)*' \
      <<<"$help" | tr ', ' '\n\n' | sort -u)" -- "$current")
    return
  fi
  local verbs
  verbs=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p' <<<"$help")
  if [[ -n $verbs && ${#words[@]} -eq $((COMP_CWORD - 1)) ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$verbs" -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
    compopt -o filenames 2>/dev/null
  fi
}
complete -F _edgescout edgescout
