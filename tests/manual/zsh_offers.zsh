# zsh_offers.zsh FOLDER LINE...: what zsh offers behind each LINE with the completion functions of FOLDER, one line a LINE.
# An interactive shell on a terminal of its own is asked, as completion needs one; it prints between marks.
zmodload zsh/zpty || exit 2
zpty shell zsh -f -i
zpty -w shell "PS1= ; stty -echo rows 500 columns 400; fpath=($1 \$fpath); autoload -Uz compinit; compinit -u -D"
zpty -w shell 'offer() { compstate[list]=""; compstate[insert]=""; _main_complete; print "<end>" }'
zpty -w shell 'compadd() { local -a hits; [[ "$*" == *-[OAD]\ * ]] || { builtin compadd -O hits "$@"; print -rl -- "<hit>"${^hits}"</hit>" }; builtin compadd "$@" }'
zpty -w shell 'zle -C offer list-choices offer; bindkey "^I" offer; bindkey "^U" kill-whole-line; print "<"ready">"'
while zpty -r shell line && [[ $line != *'<ready>'* ]]; do :; done
for text in "${@:2}"; do
  offered=()
  zpty -w -n shell $'\C-U'"$text"$'\t'
  while zpty -r shell line; do
    while [[ $line == *'<hit>'* ]]; do
      line=${line#*<hit>}
      offered+=(${line%%</hit>*})
    done
    [[ $line == *'<end>'* ]] && break
  done
  print -r -- $offered
done
zpty -d shell
