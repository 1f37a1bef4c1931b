// Which Airlight is this program linked to?
#include <airlight/render/version.h>

#include <cstdio>

int main() { std::printf("Airlight %s\n", airlight::version()); }
