// A shared library that is no plugin.
extern "C" int TimesTwo(int number);
extern "C" int TimesTwo(int number) { return 2 * number; }
