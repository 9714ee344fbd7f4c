graph [
  node [
    id 0
    label "0"
  ]
  node [
    id 1
    label "1"
  ]
  node [
    id 2
    label "2"
  ]
  node [
    id 3
    label "3"
  ]
  node [
    id 4
    label "4"
  ]
  node [
    id 5
    label "5"
  ]
  node [
    id 6
    label "6"
  ]
  edge [
    source 0
    target 1
    weight 0.25
    kind "match"
  ]
  edge [
    source 0
    target 2
    weight 1.25
    kind "match"
  ]
  edge [
    source 1
    target 2
    weight 2.25
    kind "match"
  ]
  edge [
    source 1
    target 3
    weight 3.25
    kind "match"
  ]
  edge [
    source 2
    target 3
    weight 4.25
    kind "match"
  ]
  edge [
    source 2
    target 4
    weight 5.25
    kind "match"
  ]
  edge [
    source 3
    target 4
    weight 6.25
    kind "match"
  ]
  edge [
    source 3
    target 5
    weight 7.25
    kind "match"
  ]
  edge [
    source 4
    target 5
    weight 8.25
    kind "match"
  ]
  edge [
    source 4
    target 6
    weight 9.25
    kind "match"
  ]
  edge [
    source 5
    target 6
    weight 10.25
    kind "match"
  ]
]
