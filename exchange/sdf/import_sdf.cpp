#include "plumbline/exchange/import_program.hpp"
#include "sdf_reader.hpp"

int main(int argc, char** argv) { return plumbline::import_program(argc, argv, plumbline::read_sdf); }
