#include "gz_profiler.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <ignition/common/Console.hh>
#include <string>

namespace plumbline {
namespace {

// A port that is ours as long as this lives; nobody can connect to it since it does not listen. 0 where the system has
// none to give, which leaves none to the profiler either.
class TakenPort {
 public:
  TakenPort() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    if (::bind(socket_, any, size) == 0 && ::getsockname(socket_, any, &size) == 0) number_ = ntohs(address.sin_port);
  }
  TakenPort(const TakenPort&) = delete;
  TakenPort& operator=(const TakenPort&) = delete;
  ~TakenPort() {
    if (socket_ >= 0) ::close(socket_);
  }
  int number() const { return number_; }

 private:
  int socket_;
  int number_ = 0;
};

}  // namespace

void keep_profiler_offline(const std::function<void()>& first_step) {
  const TakenPort port;
  ::setenv("RMT_PORT", std::to_string(port.number()).c_str(), 1);
  constexpr int kNothing = 0, kErrors = 1;  // kErrors: what the layer prints by itself
  ignition::common::Console::SetVerbosity(kNothing);
  first_step();
  ignition::common::Console::SetVerbosity(kErrors);
  ::unsetenv("RMT_PORT");
}

}  // namespace plumbline
