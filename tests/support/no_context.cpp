// Loaded before OSMesa and EGL: a machine on which no context of OpenGL can be made.
extern "C" void* OSMesaCreateContextAttribs(const int*, void*) { return nullptr; }
extern "C" void* eglCreateContext(void*, void*, void*, const int*) { return nullptr; }
