# Completion of skein for fish, which adds files where nothing else fits.
function __skein_complete
    set -l words (commandline -opc)
    $words[1] --complete $words[2..-1] "$(commandline -ct)" 2>/dev/null
end
complete -c skein -a '(__skein_complete)'
