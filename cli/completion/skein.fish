# Completion of skein for fish, which adds files where nothing else fits.
function __skein_complete
    set -l words (commandline -opc) (commandline -ct)
    $words[1] --complete $words[2..-1] 2>/dev/null
end
complete -c skein -a '(__skein_complete)'
