#include "tools/completion.hpp"

#include <fmt/format.h>

namespace tushar {

namespace {

// bash splits a word at = : and @, and replaces only the last part; so _sus_offer leaves out the parts before it.
constexpr const char* script = R"script(# Completion of sus in bash: source <(sus --completion bash)

# Offers the words, one per line, that begin with what has been typed.
_sus_offer() {
  local typed=$1 before one
  before=${typed%"${typed##*[=:@]}"}
  COMPREPLY=()
  while IFS= read -r one; do
    [[ -n $one && $one == "$typed"* ]] && COMPREPLY+=("${one#"$before"}")
  done <<<"$2"
}

# Offers folders and, with a pattern, files that match it.
_sus_files() {
  local typed=$1 one
  COMPREPLY=()
  while IFS= read -r one; do COMPREPLY+=("$one"); done < <(
    compgen -d -- "$typed"
    [ $# -gt 1 ] && compgen -f -X "!$2" -- "$typed"
  )
  compopt -o filenames 2>/dev/null
}

# The scene on the command line, or the folder of a run.
_sus_scene() {
  local word
  for word in "${COMP_WORDS[@]:1}"; do
    case $word in
      *.ups | *.uda | *.uda.[0-9]* | *.uda/ | *.uda.[0-9]*/) printf '%s' "${word/#\~/$HOME}"; return ;;
    esac
  done
}

_sus() {
  local line=${COMP_LINE:0:COMP_POINT} program=${COMP_WORDS[0]/#\~/$HOME} typed before scene
  typed=${line##*[[:space:]]}
  before=${line%"$typed"}
  before=${before%"${before##*[![:space:]]}"}
  before=${before##*[[:space:]]}
  COMPREPLY=()
  case ${before/#--/-} in
    -set)
      scene=$(_sus_scene)
      [[ -z $scene || $typed == *=* ]] && return
      _sus_offer "$typed" "$("$program" --paths "$scene" 2>/dev/null | sed 's/$/=/')"
      compopt -o nospace 2>/dev/null ;;
    -describe) _sus_offer "$typed" "$_sus_manuals" ;;
    -schema) _sus_offer "$typed" $'rng\nxsd' ;;
    -completion) _sus_offer "$typed" bash ;;
    -restart | -output) _sus_files "$typed" ;;
    -trace | -json | -graph) _sus_files "$typed" '*' ;;
    -t | -layout | -nthreads | -writers | -behind | -petsc | -dry-run | -checkpoint) ;;
    *)
      case $typed in
        --*) _sus_offer "$typed" "$_sus_options" ;;
        -*) _sus_offer "$typed" "${_sus_options//--/-}" ;;
        *) _sus_files "$typed" '*.ups' ;;
      esac ;;
  esac
}
)script";

std::string lines(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : "\n") + word;
  return text;
}

}  // namespace

std::string bashCompletion(const std::vector<std::string>& options, const std::vector<std::string>& manuals) {
  return fmt::format("{}\n_sus_options='{}'\n_sus_manuals='{}'\ncomplete -F _sus sus\n", script, lines(options),
                     lines(manuals));
}

}  // namespace tushar
