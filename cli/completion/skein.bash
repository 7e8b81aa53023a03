# Completion of skein for bash.
_skein() {
  local line=${COMP_LINE:0:COMP_POINT} cut
  local -a words
  read -ra words <<<"$line"
  [[ $line != *[[:space:]] ]] || words+=("")
  mapfile -t COMPREPLY < <("$1" --complete "${words[@]:1}" 2>/dev/null)
  # For bash, "a=b" is three words, of which it replaces the last.
  cut=${words[-1]%"${words[-1]##*[=:@]}"}
  COMPREPLY=("${COMPREPLY[@]#"$cut"}")
}
complete -o default -F _skein skein
