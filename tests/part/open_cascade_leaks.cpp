// Read by the sanitizers: what Open CASCADE 7.6 itself never gives back, once in a process, or for
// each file that it writes. Its libraries have no frame pointers, so whole stacks cost time.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "fast_unwind_on_malloc=0";
}

extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:STEPControl_Controller::Init\nleak:GeomToStep_MakeDirection";
}
