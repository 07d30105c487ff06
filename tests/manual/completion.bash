# completion.bash RIDGELINE RIDGELINED WORK: the completions of both shells, really run, offer what the programs take.
set -euo pipefail
ridgeline=$1 ridgelined=$2 work=$3
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work" && mkdir -p "$work/zsh" "$work/folder" && cd "$work"
touch folder/a.json folder/b.nc
source <("$ridgeline" --manual bash)
source <("$ridgelined" --manual bash)
"$ridgeline" --manual zsh >zsh/_ridgeline
"$ridgelined" --manual zsh >zsh/_ridgelined

failed=0
# expect SHELL LINE WANTED GOT
expect() {
  [ "$3" = "$4" ] && return
  printf '%s: "%s" offers\n  %s\nnot\n  %s\n' "$1" "$2" "$4" "$3"
  failed=1
}

# What bash offers behind a line; `=` is a word of its own, as on the command line.
bash_offers() {
  local line=${1//=/ = }
  read -ra COMP_WORDS <<<"$line"
  [[ $line != *' ' ]] || COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMPREPLY=()
  "_${COMP_WORDS[0]}"
  echo "${COMPREPLY[@]}"
}

# A line and what is offered behind it, in both shells.
lines=(
  'ridgeline ch' 'chamfer'
  'ridgeline macro ' 'run check make'
  'ridgeline --domain 3 --local units p' 'plan'
  'ridgeline macro run --format ' 'json nc csv svg html trace'
  'ridgeline macro run --format=j' 'json'
  'ridgeline chamfer --form' '--format'
  'ridgeline chamfer --lo' '--local'
  'ridgeline chamfer folder/' 'folder/a.json folder/b.nc'
  'ridgeline library get ' 'workpiece tool material part'
  'ridgeline library get tool ' ''
  'ridgeline chamfer -o folder/b' 'folder/b.nc'
  'ridgelined --log-level d' 'debug'
  'ridgelined --ch' '--check')
for ((i = 0; i < ${#lines[@]}; i += 2)); do
  expect bash "${lines[i]}" "${lines[i + 1]}" "$(bash_offers "${lines[i]}")"
done

# Every command and every option that --help shows, of some commands.
words() { sed -n "/^$1:/,/^\$/p" | awk -v column="$2" 'NR > 1 && /^  [^ ]/ { print $column }'; }
checked=0
compare() {
  local help options command
  help=$("$ridgeline" $1 --help)
  options=$(words Options 1 <<<"$help" | tr ',' '\n' | sort -u)
  offered=$(bash_offers "ridgeline ${1:+$1 }-" | tr ' ' '\n')
  for option in $options; do
    grep -qxF -- "$option" <<<"$offered" || { echo "bash: ridgeline $1 does not offer $option"; failed=1; }
    checked=$((checked + 1))
  done
  for command in $(words Subcommands 1 <<<"$help"); do
    [ "$(bash_offers "ridgeline ${1:+$1 }$command")" = "$command" ] || { echo "bash does not offer $1 $command"; failed=1; }
  done
}
for command in '' chamfer library 'macro run' 'units edit'; do compare "$command"; done
[ $checked -ge 30 ] || { echo "only $checked options were compared"; failed=1; }

asked=()
for ((i = 0; i < ${#lines[@]}; i += 2)); do asked+=("${lines[i]}"); done
mapfile -t offers < <(zsh -f "$here/zsh_offers.zsh" "$work/zsh" "${asked[@]}")
for ((i = 0; i < ${#lines[@]}; i += 2)); do
  # zsh completes what stands behind = and / alone
  wanted=${lines[i + 1]//folder\//}
  expect zsh "${lines[i]}" "$wanted" "${offers[i / 2]}"
done
exit $failed
