! SPDX-License-Identifier: 0BSD
! sphverify/plugin.h for Fortran: the same structures, in the same order.
module sphverify_plugin
  use, intrinsic :: iso_c_binding
  implicit none

  integer(c_int), parameter :: sphverify_plugin_version = 1

  ! enum sphverify_rate
  integer(c_int32_t), parameter :: acceleration = 0, internal_work = 1, total_work = 2, conduction_heating = 3
  ! Bits to add up: what is read
  integer(c_int32_t), parameter :: reads_density = 1, reads_velocity = 2, reads_pressure = 4, reads_temperature = 8, &
                                   reads_conductivity = 16, reads_sound_speed = 32, reads_flux = 64
  ! Bits to add up: what is conserved
  integer(c_int32_t), parameter :: conserves_momentum = 1, conserves_energy = 2

  type, bind(C) :: description
    character(kind=c_char) :: name(64), title(160), source(160), equation(480), work_partner(64)
    integer(c_int32_t) :: rate, reads, reads_at_walls, conserves, wants_neighbours, passes, thread_safe
  end type

  type, bind(C) :: wall_type
    real(c_double) :: point(3), outward_normal(3)
    integer(c_int32_t) :: prescribes
    integer(c_size_t) :: contacts
    type(c_ptr) :: particle, distance, face_weight, foot_density, pressure, temperature, conductivity
    type(c_ptr) :: velocity(3), flux(3)
  end type

  type, bind(C) :: state_type
    integer(c_int32_t) :: dimension
    integer(c_size_t) :: count
    real(c_double) :: time
    type(c_ptr) :: kernel
    real(c_double) :: support_ratio, smoothing_length
    type(c_ptr) :: smoothing_lengths, position(3), mass, density, pressure, temperature, conductivity, sound_speed, velocity(3)
    real(c_double) :: lower(3), upper(3)
    integer(c_int32_t) :: periodic(3)
    real(c_double) :: axes(9)
    type(c_ptr) :: first, neighbour
    integer(c_size_t) :: walls
    type(c_ptr) :: wall
  end type

  type, bind(C) :: rates_type
    type(c_ptr) :: pairs(3)
    type(c_ptr) :: wall  ! to pointers (3, walls)
  end type

contains

  ! Text of C from text of Fortran.
  subroutine put(text, into)
    character(len=*), intent(in) :: text
    character(kind=c_char), intent(inout) :: into(:)
    integer :: n
    do n = 1, len(text)
      into(n) = text(n:n)
    end do
    into(len(text) + 1) = c_null_char
  end subroutine

  ! Text of Fortran from text of C.
  function text_of(from) result(text)
    type(c_ptr), intent(in) :: from
    character(len=:), allocatable :: text
    character(kind=c_char), pointer :: letters(:)
    integer :: n
    call c_f_pointer(from, letters, [64])
    text = ""
    do n = 1, 64
      if (letters(n) == c_null_char) exit
      text = text//letters(n)
    end do
  end function
end module
