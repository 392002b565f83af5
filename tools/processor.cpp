// Ends sus with a sentence, rather than by SIGILL, if the processor lacks instructions for which sus was compiled. The
// dynamic loader calls the functions in .preinit_array of a program before the initialisers of its libraries, and thus
// before any instruction that may be missing. The functions here contain only instructions that every x86-64 has.
#if defined(__x86_64__) && defined(__GNUC__)
#include <unistd.h>

#include <cstring>

#define TUSHAR_ANY_PROCESSOR [[gnu::target("arch=x86-64")]]
#define TUSHAR_TEXT(words) #words
/// `name` if the compiler used these instructions and the processor lacks them; otherwise the value written after the
/// macro. A compiler that uses them defines `macro` as 1.
#define TUSHAR_IF_MISSING(macro, name) TUSHAR_TEXT(macro)[0] == '1' && !__builtin_cpu_supports(name) ? name:

namespace {

/// The first required instruction set that the processor lacks; a null pointer if there is none.
TUSHAR_ANY_PROCESSOR const char* missingInstructions() {
  __builtin_cpu_init();
  // clang-format off
  return TUSHAR_IF_MISSING(__SSE3__, "sse3")
         TUSHAR_IF_MISSING(__SSSE3__, "ssse3")
         TUSHAR_IF_MISSING(__SSE4_1__, "sse4.1")
         TUSHAR_IF_MISSING(__SSE4_2__, "sse4.2")
         TUSHAR_IF_MISSING(__POPCNT__, "popcnt")
         TUSHAR_IF_MISSING(__AVX__, "avx")
         TUSHAR_IF_MISSING(__AVX2__, "avx2")
         TUSHAR_IF_MISSING(__FMA__, "fma")
         TUSHAR_IF_MISSING(__BMI__, "bmi")
         TUSHAR_IF_MISSING(__BMI2__, "bmi2")
         TUSHAR_IF_MISSING(__AVX512F__, "avx512f")
         TUSHAR_IF_MISSING(__AVX512VL__, "avx512vl")
         TUSHAR_IF_MISSING(__AVX512BW__, "avx512bw")
         TUSHAR_IF_MISSING(__AVX512DQ__, "avx512dq")
         TUSHAR_IF_MISSING(__AVX512CD__, "avx512cd")
         TUSHAR_IF_MISSING(__AVX512VBMI__, "avx512vbmi")
         TUSHAR_IF_MISSING(__AVX512VBMI2__, "avx512vbmi2")
         TUSHAR_IF_MISSING(__AVX512BITALG__, "avx512bitalg")
         TUSHAR_IF_MISSING(__AVX512VPOPCNTDQ__, "avx512vpopcntdq")
         nullptr;
  // clang-format on
}

TUSHAR_ANY_PROCESSOR void say(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(1);
}

/// Checks the processor; called before main.
TUSHAR_ANY_PROCESSOR void checkProcessor() {
  const char* const missing = missingInstructions();
  if (missing == nullptr) return;
  say("sus: this processor lacks instructions (");
  say(missing);
  say(") for which sus was compiled; build it on this machine, or for any machine with -DTUSHAR_NATIVE=OFF "
      "-DTUSHAR_PROCESSOR=x86-64 [T709]\n");
  _exit(1);
}

[[gnu::section(".preinit_array"), gnu::used]] void (*const check)() = checkProcessor;

}  // namespace
#endif
