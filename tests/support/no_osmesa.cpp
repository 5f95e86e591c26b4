// Loaded before OSMesa: a machine on which no context can be made.
extern "C" void* OSMesaCreateContextAttribs(const int*, void*) { return nullptr; }
