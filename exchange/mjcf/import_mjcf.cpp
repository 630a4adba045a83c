#include "mjcf_reader.hpp"
#include "plumbline/exchange/import_program.hpp"

int main(int argc, char** argv) { return plumbline::import_program(argc, argv, plumbline::read_mjcf); }
