// Read by the leak sanitizer: Open CASCADE keeps what its STEP writer and translators once made.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libTK";
}
