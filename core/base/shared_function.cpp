#include "core/base/shared_function.hpp"

namespace tushar {

SharedObject::SharedObject(void* object, Destroy destroy) : object_(object, destroy) {}
void* SharedObject::room(std::size_t size) { return ::operator new (size, std::align_val_t{alignment}); }
void SharedObject::release(void* object) { ::operator delete (object, std::align_val_t{alignment}); }

}  // namespace tushar
